// SPDX-License-Identifier: BSD-3-Clause
#include "slipProposals.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace salma::slam {

namespace {

constexpr double largestSlip = 3;  // that is thought of [sigma]
constexpr double oneSlip = 0.08;   // pairs that propose it agree so well [m]
constexpr std::size_t mostProposals = 3;

Eigen::Vector2d pointOf(const Eigen::Vector2d& z) {
    return {z[0] * std::cos(z[1]), z[0] * std::sin(z[1])};
}

/// One for each pair of a tracked landmark and a measurement that a slip may have parted.
std::vector<double> shiftsOfPairs(const TSlipOptions& options,
                                  const association::TAssociationProblem& problem,
                                  const std::vector<bool>& tracked,
                                  const Eigen::Vector2d& direction) {
    const Eigen::Vector2d across(-direction.y(), direction.x());
    std::vector<double> shifts;
    for (const auto& m : problem.measurements) {
        if (!m.z.allFinite()) continue;
        for (std::size_t k = 0; k < problem.landmarks.size(); ++k) {
            const auto& landmark = problem.landmarks[k];
            if (!tracked[k] || landmark.kind != m.kind || landmark.convex != m.convex) continue;
            const Eigen::Vector2d apart = pointOf(landmark.z) - pointOf(m.z);
            if (std::abs(apart.dot(across)) <= oneSlip + options.turn * landmark.z[0] &&
                std::abs(apart.dot(direction)) <= largestSlip * options.along)
                shifts.push_back(apart.dot(direction));
        }
    }
    return shifts;
}

}  // namespace

std::vector<double> slipProposals(const TSlipOptions& options,
                                  const association::TAssociationProblem& problem,
                                  const std::vector<bool>& tracked,
                                  const Eigen::Vector2d& direction,
                                  std::size_t leastPairs) {
    const std::vector<double> shifts = shiftsOfPairs(options, problem, tracked, direction);
    std::vector<std::pair<std::size_t, double>> clusters;  // pairs, their mean
    for (const double shift : shifts) {
        double sum = 0;
        std::size_t count = 0;
        for (const double other : shifts)
            if (std::abs(other - shift) <= oneSlip) {
                sum += other;
                ++count;
            }
        clusters.emplace_back(count, sum / static_cast<double>(count));
    }
    std::stable_sort(clusters.begin(), clusters.end(), [](const auto& a, const auto& b) {
        return a.first != b.first ? a.first > b.first : std::abs(a.second) < std::abs(b.second);
    });
    std::vector<double> result;
    for (const auto& cluster : clusters) {
        const double shift = cluster.second;
        const bool isNew = std::none_of(result.begin(), result.end(), [shift](double other) {
            return std::abs(other - shift) <= oneSlip;
        });
        if (isNew && cluster.first >= leastPairs && std::abs(shift) > oneSlip &&
            result.size() < mostProposals)
            result.push_back(shift);
    }
    return result;
}

}  // namespace salma::slam
