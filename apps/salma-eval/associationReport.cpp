// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "reports.h"

namespace salma::apps {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kMaxListed = 20;  // the JSON lists all

void writeRow(std::ostream& out, const std::string& name, std::size_t value) {
    out << "  " << std::left << std::setw(46) << name << std::right << std::setw(7) << value
        << "\n";
}

void writeRow(std::ostream& out, const std::string& name, const TProportion& p) {
    out << "  " << std::left << std::setw(46) << name << std::right << std::setw(7) << p.count
        << " of " << p.total;
    if (p.total > 0)
        out << std::fixed << std::setprecision(1) << " = " << 100 * p.share()
            << " % (95 %: " << 100 * p.low << " to " << 100 * p.high << ")";
    out << "\n";
}

void writeLists(std::ostream& out, const TAssociationFigures& f) {
    std::size_t listed = 0;
    for (const auto& w : f.wrong) {
        if (++listed > kMaxListed) {
            out << "  ... and " << f.wrong.size() - kMaxListed << " more\n";
            break;
        }
        out << "  wrong: t " << std::fixed << std::setprecision(6) << w.time << " observation "
            << w.observation << " of true " << w.observationTruth << " paired with landmark "
            << w.landmark << ", which is true " << w.landmarkTruth << "\n";
    }
    for (const auto& d : f.duplicates) {
        out << "  true " << d.truth << " is in the map as landmarks";
        for (const int landmark : d.landmarks) out << " " << landmark;
        out << "\n";
    }
}

void writeKind(std::ostream& out, const std::string& name, const TAssociationFigures& f) {
    out << name << "\n";
    writeRow(out, "observations", f.observations);
    writeRow(out, "of no true landmark (false entities)", f.falseEntities);
    writeRow(out, "precision of pairings", f.precision);
    writeRow(out, "recall of sightings of mapped landmarks", f.recall);
    writeRow(out, "sightings of mapped landmarks deferred", f.deferred);
    writeRow(out, "wrong pairings between true landmarks", f.wrong.size());
    writeRow(out, "pairings of a true with a false landmark", f.wrongWithFalse);
    writeRow(out, "pairings that cannot be judged", f.unjudged);
    writeRow(out, "landmarks made", f.landmarksMade);
    writeRow(out, "true landmarks in the world", f.trueLandmarks);
    writeRow(out, "true landmarks in the map", f.landmarksCovered);
    writeRow(out, "duplicates", f.duplicateLandmarks());
    writeRow(out, "landmarks that are no true landmark", f.falseLandmarks);
    writeLists(out, f);
}

ordered_json asJson(const TProportion& p) {
    ordered_json json{{"count", p.count}, {"total", p.total}};
    json["share"] = p.total > 0 ? ordered_json(p.share()) : ordered_json(nullptr);
    json["low_95"] = p.low;
    json["high_95"] = p.high;
    return json;
}

ordered_json asJson(const TAssociationFigures& f) {
    ordered_json json;
    json["observations"] = f.observations;
    json["false_entities"] = f.falseEntities;
    json["precision"] = asJson(f.precision);
    json["recall"] = asJson(f.recall);
    json["deferred_resightings"] = f.deferred;
    json["wrong_pairings"] = f.wrong.size();
    json["wrong_with_false"] = f.wrongWithFalse;
    json["unjudged"] = f.unjudged;
    json["landmarks_made"] = f.landmarksMade;
    json["landmarks_true"] = f.trueLandmarks;
    json["landmarks_covered"] = f.landmarksCovered;
    json["duplicates"] = f.duplicateLandmarks();
    json["false_landmarks"] = f.falseLandmarks;
    json["wrong"] = ordered_json::array();
    for (const auto& w : f.wrong)
        json["wrong"].push_back({{"t_s", w.time},
                                 {"observation", w.observation},
                                 {"true_id", w.observationTruth},
                                 {"landmark_id", w.landmark},
                                 {"landmark_true_id", w.landmarkTruth}});
    json["duplicated"] = ordered_json::array();
    for (const auto& d : f.duplicates)
        json["duplicated"].push_back({{"true_id", d.truth}, {"landmark_ids", d.landmarks}});
    return json;
}

}  // namespace

std::string associationTable(const TAssociationReport& report) {
    std::ostringstream out;
    out << "truth: " << report.truthName << "\n\n";
    writeKind(out, "salient landmarks", report.salient);
    out << "\n";
    if (report.corners)
        writeKind(out, "corners", *report.corners);
    else
        out << "corners: not scored, the truth holds no corners or no path of the robot\n";
    return out.str();
}

std::string associationJson(const TAssociationReport& report) {
    ordered_json json;
    json["truth"] = report.truthName;
    json["salient"] = asJson(report.salient);
    json["corners"] = report.corners ? asJson(*report.corners) : ordered_json(nullptr);
    return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace salma::apps
