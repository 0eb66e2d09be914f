// SPDX-License-Identifier: BSD-3-Clause
#include "CFitRounds.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace salma::calibration {

TOutline::TOutline(const std::vector<mrpt::math::TPoint2D>& points, double margin) {
    for (const auto& p : points) right = std::max(right, p.x), bottom = std::max(bottom, p.y);
    left -= margin, top -= margin, right += margin, bottom += margin;
}

std::vector<std::size_t> CFitRounds::beamsOn(std::size_t pair,
                                             const TJointState& state,
                                             double limit) const {
    const auto& scan = m_pairs[pair].scan;
    const TLaserPose pose = state.pose();
    const TPlane plane = state.plane(pair);
    std::vector<std::size_t> beams;
    std::size_t expected = 0;
    for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
        const double a = scan.direction(i);
        const Eigen::Vector3d along = pose.R.col(0) * std::cos(a) + pose.R.col(1) * std::sin(a);
        const double steepness = plane.normal.dot(along);
        const double range = -plane.offset(pose.t) / steepness;  // where the beam meets the plane
        // a beam along the board tells little, and its range would not be linear
        if (!(std::abs(steepness) > 0.15) || !(range > 0)) continue;
        const Eigen::Vector3d place = state.onBoard(pair, pose.t + range * along);
        if (!m_outline.contains(place)) continue;
        ++expected;
        const double miss = scan.ranges[i] - state.offset(m_fit.isDark(pair, place)) - range;
        if (std::abs(miss * steepness) <= limit) beams.push_back(i);
    }
    // Where most of the beams that should meet the board end elsewhere, scan and picture do not
    // belong together.
    if (beams.size() < static_cast<std::size_t>(m_options.minPoints) || 2 * beams.size() < expected)
        beams.clear();
    return beams;
}

CFitRounds::TBeams CFitRounds::run(const std::vector<bool>& use, TJointState& state) const {
    TBeams beams;
    double limit = 2 * m_options.tolerance;
    for (int round = 0; round < 4; ++round) {
        beams.assign(m_pairs.size(), {});
        for (std::size_t i = 0; i < m_pairs.size(); ++i)
            if (use[i]) beams[i] = beamsOn(i, state, limit);
        const auto count =
            std::count_if(beams.begin(), beams.end(), [](const auto& b) { return !b.empty(); });
        if (count < m_options.minPairs)
            throw std::runtime_error("only " + std::to_string(count) +
                                     " pairs of picture and scan agree on a pose; " +
                                     std::to_string(m_options.minPairs) + " are needed");
        m_fit.run(beams, state);
        m_fit.estimateSigmas(beams, state);
        limit = std::min(limit, m_options.gate * m_fit.sigmaRange);
    }
    return beams;
}

}  // namespace salma::calibration
