// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "reports.h"

namespace salma::apps {
namespace {

using nlohmann::ordered_json;
using viz::TErrorFigures;

constexpr double kDegrees = 180 / M_PI;

void writeRow(std::ostream& out, const std::string& name, const TErrorFigures& e, double unit) {
    out << std::left << std::setw(34) << name << std::right << std::fixed << std::setprecision(4)
        << std::setw(10) << e.rmse * unit << std::setw(10) << e.mean * unit << std::setw(10)
        << e.max * unit << std::setw(8) << e.count << "\n";
}

std::string shortNumber(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

ordered_json asJson(const TErrorFigures& e, const std::string& unit) {
    const double factor = unit == "deg" ? kDegrees : 1;
    return {{"rmse_" + unit, e.rmse * factor},
            {"mean_" + unit, e.mean * factor},
            {"max_" + unit, e.max * factor},
            {"count", e.count}};
}

ordered_json asJson(const viz::TRelativeError& e) {
    return {{"translation", asJson(e.translation, "m")}, {"rotation", asJson(e.rotation, "deg")}};
}

}  // namespace

std::string trajectoryTable(const viz::TTrajectoryFigures& f, const viz::TScoreOptions& options) {
    std::ostringstream out;
    out << f.pairs << " poses compared, " << f.unmatched
        << " without a reference; the reference is " << std::fixed << std::setprecision(2)
        << f.referenceLength << " m long\n\n";
    out << std::left << std::setw(34) << "error" << std::right << std::setw(10) << "RMSE"
        << std::setw(10) << "mean" << std::setw(10) << "max" << std::setw(8) << "count"
        << "\n";
    writeRow(out, "ATE aligned [m]", f.aligned, 1);
    writeRow(out, "ATE not aligned [m]", f.unaligned, 1);
    writeRow(out, "heading aligned [deg]", f.alignedHeading, kDegrees);
    const std::string metres = "RPE over " + shortNumber(options.deltaMetres) + " m";
    const std::string seconds = "RPE over " + shortNumber(options.deltaSeconds) + " s";
    writeRow(out, metres + ", position [m]", f.perMetres.translation, 1);
    writeRow(out, metres + ", heading [deg]", f.perMetres.rotation, kDegrees);
    writeRow(out, seconds + ", position [m]", f.perTime.translation, 1);
    writeRow(out, seconds + ", heading [deg]", f.perTime.rotation, kDegrees);
    out << "\nalignment: x " << f.T_ref_est.x() << " m, y " << f.T_ref_est.y() << " m, heading "
        << f.T_ref_est.phi() * kDegrees << " deg\n";
    return out.str();
}

std::string trajectoryJson(const viz::TTrajectoryFigures& f, const viz::TScoreOptions& options) {
    ordered_json json;
    json["pairs"] = f.pairs;
    json["unmatched"] = f.unmatched;
    json["reference_length_m"] = f.referenceLength;
    json["ate_aligned"] = asJson(f.aligned, "m");
    json["ate_unaligned"] = asJson(f.unaligned, "m");
    json["heading_aligned"] = asJson(f.alignedHeading, "deg");
    json["rpe_distance"] = asJson(f.perMetres);
    json["rpe_distance"]["delta_m"] = options.deltaMetres;
    json["rpe_time"] = asJson(f.perTime);
    json["rpe_time"]["delta_s"] = options.deltaSeconds;
    json["alignment"] = {{"x_m", f.T_ref_est.x()},
                         {"y_m", f.T_ref_est.y()},
                         {"yaw_deg", f.T_ref_est.phi() * kDegrees}};
    return json.dump(2) + "\n";
}

}  // namespace salma::apps
