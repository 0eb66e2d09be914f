// SPDX-License-Identifier: BSD-3-Clause
#include "calibrationFiles.h"

#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace salma::apps {
namespace {

constexpr double kDegrees = 180 / M_PI;

/// Shortest of up to 6 digits; "" for NaN, "inf" for what has no limit.
std::string number(double value) {
    if (std::isnan(value)) return "";
    std::ostringstream text;
    text << value;
    return text.str();
}

std::string stamp(double seconds) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(6) << seconds;
    return text.str();
}

/// The lines of a section that set one of these keys.
std::string linesOf(const std::string& section, const std::vector<std::string>& keys) {
    std::istringstream in(section);
    std::string result;
    for (std::string line; std::getline(in, line);)
        for (const auto& key : keys)
            if (line.rfind(key + " ", 0) == 0) result += line + "\n";
    return result;
}

void addBins(std::ostream& out, const std::string& name, const TRatioTable& table) {
    for (const auto& bin : table.bins)
        out << name << "," << number(bin.from) << "," << number(bin.to) << "," << bin.same << ","
            << bin.other << "," << number(bin.counted) << "," << number(bin.logRatio) << "\n";
}

std::string nameOf(EPair kind) {
    if (kind == EPair::same) return "same";
    return kind == EPair::other ? "other" : "duplicate";
}

std::string nameOf(appearance::EEvidence evidence) {
    if (evidence == appearance::EEvidence::none) return "none";
    return evidence == appearance::EEvidence::keypoints ? "keypoints" : "both";
}

void addPairs(std::ostream& out, const std::string& runs, const TRunSet& set) {
    for (std::size_t r = 0; r < set.runs.size(); ++r)
        for (const auto& pair : set.pairs[r]) {
            const TSeenPoster &a = set.runs[r].seen[pair.a], &b = set.runs[r].seen[pair.b];
            out << runs << "," << set.runs[r].folder << "," << stamp(a.time) << "," << stamp(b.time)
                << "," << a.poster << "," << b.poster << "," << number(a.angle * kDegrees) << ","
                << number(b.angle * kDegrees) << "," << nameOf(pair.kind) << ","
                << nameOf(pair.evidence) << "," << number(pair.score) << ","
                << number(pair.keypointScore) << "," << number(pair.configuredRatio) << "\n";
        }
}

void addReliability(std::ostream& out,
                    const std::string& runs,
                    const std::string& tables,
                    const TReliability& r) {
    for (const auto& bin : r.bins)
        out << runs << "," << tables << "," << number(bin.predicted) << "," << bin.same << ","
            << bin.other << "," << number(bin.counted.value) << "," << number(bin.counted.low)
            << "," << number(bin.counted.high) << "\n";
}

}  // namespace

std::string calibrationIni(const TCalibration& c) {
    std::string text =
        "# Learned by `salma-landmarks calibrate`; every other key keeps its default.\n[matcher]\n";
    text += linesOf(c.matcher.asIni("matcher"), {"duplicate_rate", "score_knots", "log_lr_knots",
                                                 "keypoint_score_knots", "keypoint_log_lr_knots"});
    if (c.decorrelated.angle) {
        slam::TEkfOptions ekf;
        ekf.decorrelation = *c.decorrelated.angle;
        text += "\n[ekf]\n" + linesOf(ekf.asIni("ekf"), {"decorrelation_deg"});
    }
    auto detection = c.detection;
    text += "\n" + detection.asIni("detection");
    return text;
}

std::string binsCsv(const TCalibration& c) {
    std::ostringstream out;
    out << "table,score_from,score_to,same,other,counted_log_lr,log_lr\n";
    addBins(out, "both", c.both);
    addBins(out, "keypoints", c.keypoints);
    return out.str();
}

std::string pairsCsv(const TCalibration& c) {
    std::ostringstream out;
    out << "runs,folder,t_a_s,t_b_s,poster_a,poster_b,angle_a_deg,angle_b_deg,kind,evidence,score,"
           "keypoint_score,configured_log_lr\n";
    addPairs(out, "learning", c.learning);
    if (c.report) addPairs(out, "report", *c.report);
    return out.str();
}

std::string reliabilityCsv(const TCalibration& c) {
    std::ostringstream out;
    out << "runs,tables,predicted_log_lr,same,other,counted_log_lr,low,high\n";
    addReliability(out, "learning", "learned", c.learning.learned);
    addReliability(out, "learning", "configured", c.learning.configured);
    if (!c.report) return out.str();
    addReliability(out, "report", "learned", c.report->learned);
    addReliability(out, "report", "configured", c.report->configured);
    return out.str();
}

std::string decorrelationCsv(const TCalibration& c) {
    std::ostringstream out;
    out << "change_from_deg,change_to_deg,pairs,correlation,fitted\n";
    for (const auto& bin : c.decorrelated.bins)
        if (bin.pairs > 0)
            out << number(bin.from * kDegrees) << "," << number(bin.to * kDegrees) << ","
                << bin.pairs << "," << number(bin.correlation) << "," << number(bin.fitted) << "\n";
    return out.str();
}

std::string detectionCsv(const TCalibration& c) {
    std::ostringstream out;
    out << "incidence_from_deg,incidence_to_deg,range_from_m,range_to_m,views,seen,share,low,"
           "high\n";
    for (const auto& cell : c.detected)
        out << number(cell.incidenceFrom * kDegrees) << "," << number(cell.incidenceTo * kDegrees)
            << "," << number(cell.rangeFrom) << "," << number(cell.rangeTo) << ","
            << cell.seen.total << "," << cell.seen.count << "," << number(cell.seen.share()) << ","
            << number(cell.seen.low) << "," << number(cell.seen.high) << "\n";
    return out.str();
}

}  // namespace salma::apps
