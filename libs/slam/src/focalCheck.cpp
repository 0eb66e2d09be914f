// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/slam/focalCheck.h>

#include <cmath>
#include <map>
#include <vector>

namespace salma::slam {
namespace {

constexpr std::size_t kLeastSightings = 20;
constexpr double kLeastSpread = 0.03;  // of sin(a) cos(a): two degrees
constexpr double kSignificance = 4;    // sigma
constexpr double kHarmless = 0.015;    // 2 cm at 4 m and 24 degrees off the axis

struct TSample {
    double lever{0};     //!< sin(a) cos(a).
    double residual{0};  //!< Bearing as measured, less that to the landmark of the map [rad].
};

using Samples = std::map<int, std::vector<TSample>>;  // by landmark

Samples samplesOf(const TRunRecord& record) {
    std::map<int, mrpt::math::TPoint2D> places;
    for (const auto& landmark : record.landmarks) places[landmark.id] = landmark.mean;
    std::map<double, mrpt::poses::CPose2D> poses;
    for (const auto& row : record.trajectory) poses[row.time] = row.pose;
    Samples result;
    for (const auto& row : record.associations) {
        const bool used = row.decision == EDecision::paired || row.decision == EDecision::created;
        const auto place = places.find(row.landmark);
        const auto pose = poses.find(row.time);
        if (!used || std::isnan(row.axisAngle) || place == places.end() || pose == poses.end())
            continue;
        const auto& T_w_r = pose->second;
        const double expected =
            std::atan2(place->second.y - T_w_r.y(), place->second.x - T_w_r.x()) - T_w_r.phi();
        result[row.landmark].push_back({std::sin(row.axisAngle) * std::cos(row.axisAngle),
                                        mrpt::math::wrapToPi(row.bearing - expected)});
    }
    return result;
}

/// Takes a landmark's means off its samples: its own place in the map may be wrong.
void centre(std::vector<TSample>& samples) {
    TSample mean;
    const auto n = static_cast<double>(samples.size());
    for (const auto& s : samples) {
        mean.lever += s.lever / n;
        mean.residual += s.residual / n;
    }
    for (auto& s : samples) {
        s.lever -= mean.lever;
        s.residual -= mean.residual;
    }
}

}  // namespace

bool TFocalCheck::isWrong() const {
    return std::abs(error) > kHarmless && std::abs(error) > kSignificance * sigma;
}

std::optional<TFocalCheck> checkFocalLength(const TRunRecord& record) {
    TFocalCheck result;
    std::size_t unknowns = 1;  // the slope, and the place of each landmark
    double ll = 0, lr = 0, rr = 0;
    auto all = samplesOf(record);
    for (auto& [landmark, samples] : all) {
        if (samples.size() < 2) continue;
        centre(samples);
        ++unknowns;
        result.sightings += samples.size();
        for (const auto& s : samples) {
            ll += s.lever * s.lever;
            lr += s.lever * s.residual;
            rr += s.residual * s.residual;
        }
    }
    const auto n = static_cast<double>(result.sightings);
    if (result.sightings < kLeastSightings || result.sightings <= unknowns ||
        !(ll > n * kLeastSpread * kLeastSpread))
        return std::nullopt;
    result.error = lr / ll;
    const double scatter = std::max(0.0, rr - lr * result.error);
    result.sigma = std::sqrt(scatter / (n - static_cast<double>(unknowns)) / ll);
    return result;
}

}  // namespace salma::slam
