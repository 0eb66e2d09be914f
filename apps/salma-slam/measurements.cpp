// SPDX-License-Identifier: BSD-3-Clause
#include "measurements.h"

#include <salma/appearance/TPolarMeasurement.h>

#include <cmath>
#include <limits>

namespace salma::apps {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

}  // namespace

mrpt::math::TPoint2D centreOf(const observations::TPatch& patch) {
    const auto& q = patch.quad;
    const mrpt::math::TPoint2D a = q[2] - q[0], b = q[3] - q[1], c = q[1] - q[0];
    const double cross = a.x * b.y - a.y * b.x;
    if (!(std::abs(cross) > 1e-9)) return q[0];
    return q[0] + a * ((c.x * b.y - c.y * b.x) / cross);
}

void addMeasurement(const association::TMeasurement& measurement, slam::TStepInput& step) {
    step.measurements.push_back(measurement);
    step.pixels.emplace_back(kNone, kNone);
}

void addCorner(const laser::TCorner& corner, slam::TStepInput& step) {
    const double x = corner.position.x, y = corner.position.y, range = std::hypot(x, y);
    if (!(range > 1e-6)) return;
    Eigen::Matrix2d J;  // of (range, bearing) by (x, y)
    J << x / range, y / range, -y / (range * range), x / (range * range);
    association::TMeasurement m;
    m.kind = association::ELandmarkKind::corner;
    m.z = {range, std::atan2(y, x)};
    m.R = J * corner.covariance * J.transpose();
    m.convex = corner.convex;
    addMeasurement(m, step);
}

void addPatch(const observations::TPatch& patch, slam::TStepInput& step) {
    const auto polar = appearance::polarMeasurement(patch);
    association::TMeasurement m;
    m.kind = association::ELandmarkKind::salient;
    m.z = polar.z;
    m.R = polar.R;
    m.wallAngle = polar.wallAngle;
    m.wallAngleSigma = polar.wallAngleSigma;
    m.patch = std::make_shared<observations::TPatch>(patch);
    step.measurements.push_back(m);
    step.pixels.push_back(centreOf(patch));
}

}  // namespace salma::apps
