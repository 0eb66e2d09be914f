// SPDX-License-Identifier: BSD-3-Clause
#include "TStepScene.h"

#include <salma/slam/rangeBearingModel.h>

#include <algorithm>
#include <numeric>

namespace salma::bench {
namespace {

constexpr std::size_t kAtATime = 50;
constexpr double kApart = 1.5;  // [m]

association::TMeasurement sight(const TStepScene& scene,
                                const Eigen::Vector3d& pose,
                                std::size_t landmark) {
    association::TMeasurement m;
    m.z = slam::sighting(pose, scene.landmarks[landmark]).z;
    m.R = Eigen::Vector2d(1e-4, 1e-6).asDiagonal();
    m.identity = static_cast<int>(landmark);
    return m;
}

Eigen::Vector3d middle(const TStepScene& scene) {
    return {scene.landmarks[scene.landmarks.size() / 2].x(), 0, 0};
}

slam::TStepInput atRest() {
    slam::TStepInput step;
    step.increment.cov.setDiagonal(3, 1e-8);
    return step;
}

}  // namespace

TStepScene::TStepScene(std::size_t count) {
    for (std::size_t k = 0; k < count; ++k)
        landmarks.emplace_back(kApart * (1 + static_cast<double>(k / 2)), k % 2 == 0 ? 1.5 : -1.5);
}

std::vector<slam::TStepInput> TStepScene::fill() const {
    std::vector<slam::TStepInput> steps;
    for (std::size_t k = 0; k < landmarks.size(); ++k) {
        if (k % kAtATime == 0) steps.push_back(atRest());
        steps.back().measurements.push_back(sight(*this, {0, 0, 0}, k));
    }
    return steps;
}

slam::TStepInput TStepScene::toTheMiddle() const {
    slam::TStepInput step = atRest();
    step.increment.mean.x(middle(*this)[0]);
    return step;
}

slam::TStepInput TStepScene::step() const {
    std::vector<std::size_t> order(landmarks.size());
    std::iota(order.begin(), order.end(), 0);
    const Eigen::Vector3d pose = middle(*this);
    const auto distance = [&](std::size_t k) { return (landmarks[k] - pose.head<2>()).norm(); };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
    slam::TStepInput result = atRest();
    for (std::size_t k = 0; k < std::min(seen, order.size()); ++k)
        result.measurements.push_back(sight(*this, pose, order[k]));
    return result;
}

}  // namespace salma::bench
