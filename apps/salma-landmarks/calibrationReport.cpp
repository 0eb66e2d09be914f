// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "calibrationFiles.h"

namespace salma::apps {
namespace {

using nlohmann::ordered_json;

constexpr double kDegrees = 180 / M_PI;

std::string asText(const TFigure& f) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(4) << f.value << " (" << f.low << " to " << f.high
         << ")";
    return text.str();
}

void writeSet(std::ostream& out, const std::string& name, const TRunSet& set) {
    std::size_t pictures = 0, seen = 0, strangers = 0;
    for (const auto& run : set.runs) {
        pictures += run.pictures;
        seen += run.seen.size();
        strangers += run.strangers;
    }
    out << name << ": " << set.runs.size() << " runs, " << pictures << " pictures, " << seen
        << " sightings of " << set.posters << " posters' pictures, " << strangers
        << " other entities\n  pairs: same " << set.counts.same << ", other " << set.counts.other
        << ", duplicate " << set.counts.duplicate << ", without evidence " << set.counts.silent
        << "\n";
    const auto line = [&](const std::string& title, const TFigure& learned,
                          const TFigure& configured) {
        out << "  " << std::left << std::setw(26) << title << std::setw(30) << asText(learned)
            << asText(configured) << "\n";
    };
    out << "  " << std::left << std::setw(26) << "(95 % by pictures)" << std::setw(30)
        << "learned tables"
        << "tables of the configuration\n";
    line("area under the curve", set.learned.areaUnderCurve, set.configured.areaUnderCurve);
    line("log loss [nat]", set.learned.logLoss, set.configured.logLoss);
    line("calibration error", set.learned.calibrationError, set.configured.calibrationError);
    const auto detectionLine = [&](const std::string& title, const TDetectionLoss& loss) {
        if (loss.views == 0) return;
        out << "  " << std::left << std::setw(26) << title << std::fixed << std::setprecision(4)
            << std::setw(30) << loss.learned << loss.configured << "  (" << loss.found << " of "
            << loss.views << " found)\n";
    };
    detectionLine("posters in view, log loss", set.posterDetection);
    detectionLine("corners in view, log loss", set.cornerDetection);
    out << "  area without duplicates   " << std::fixed << std::setprecision(5)
        << set.areaWithoutDuplicates << "\n\n";
}

ordered_json asJson(const TFigure& f) {
    return {{"value", f.value}, {"low", f.low}, {"high", f.high}};
}

ordered_json asJson(const TReliability& r) {
    return {{"area_under_curve", asJson(r.areaUnderCurve)},
            {"log_loss", asJson(r.logLoss)},
            {"calibration_error", asJson(r.calibrationError)}};
}

ordered_json asJson(const TDetectionLoss& loss) {
    return {{"views", loss.views},
            {"found", loss.found},
            {"log_loss", {{"learned", loss.learned}, {"configured", loss.configured}}}};
}

ordered_json asJson(const TRunSet& set) {
    ordered_json json;
    for (const auto& run : set.runs)
        json["runs"].push_back({{"folder", run.folder},
                                {"pictures", run.pictures},
                                {"sightings", run.seen.size()},
                                {"other_entities", run.strangers}});
    json["posters"] = set.posters;
    json["pairs"] = {{"same", set.counts.same},
                     {"other", set.counts.other},
                     {"duplicate", set.counts.duplicate},
                     {"without_evidence", set.counts.silent}};
    json["learned"] = asJson(set.learned);
    json["configured"] = asJson(set.configured);
    json["area_without_duplicates"] = set.areaWithoutDuplicates;
    json["detection"] = {{"posters", asJson(set.posterDetection)},
                         {"corners", asJson(set.cornerDetection)}};
    return json;
}

}  // namespace

std::string calibrationTable(const TCalibration& c) {
    std::ostringstream out;
    writeSet(out, "learning", c.learning);
    if (c.report) writeSet(out, "report", *c.report);
    out << "duplicate rate " << std::setprecision(4) << c.duplicates.rate << " over "
        << c.duplicates.posterPairs << " pairs of places, " << c.duplicates.prints
        << " of them with one picture\n";
    if (c.decorrelated.angle)
        out << "decorrelation " << std::setprecision(1) << *c.decorrelated.angle * kDegrees
            << " deg over " << c.decorrelated.tracks << " tracks\n";
    for (const auto& notice : c.notices) out << "notice: " << notice << "\n";
    return out.str();
}

std::string calibrationJson(const TCalibration& c) {
    ordered_json json;
    json["learning"] = asJson(c.learning);
    if (c.report) json["report"] = asJson(*c.report);
    json["duplicate_rate"] = {{"value", c.duplicates.rate},
                              {"pairs_of_places", c.duplicates.posterPairs},
                              {"prints", c.duplicates.prints}};
    if (c.decorrelated.angle) json["decorrelation_deg"] = *c.decorrelated.angle * kDegrees;
    json["tracks"] = c.decorrelated.tracks;
    json["notices"] = c.notices;
    return json.dump(2) + "\n";
}

}  // namespace salma::apps
