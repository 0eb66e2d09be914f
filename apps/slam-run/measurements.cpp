// SPDX-License-Identifier: BSD-3-Clause
#include "measurements.h"

#include <salma/slam/salientMeasurement.h>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace salma::apps {
namespace {

/// Direction of a point (robot frame) right of the camera's axis [rad].
double axisAngleOf(const mrpt::math::TPoint3D& point, const mrpt::poses::CPose3D& T_r_c) {
    mrpt::math::TPoint3D inCamera;
    T_r_c.inverseComposePoint(point, inCamera);
    return std::atan2(inCamera.x, inCamera.z);
}

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
    step.spots.emplace_back();
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

void addPatch(const observations::TPatch& patch,
              const mrpt::poses::CPose3D& T_r_c,
              slam::TStepInput& step) {
    step.measurements.push_back(
        slam::measurementOf(std::make_shared<const observations::TPatch>(patch)));
    slam::TSpot spot;
    spot.pixel = centreOf(patch);
    spot.axisAngle = axisAngleOf(patch.pose.mean.translation(), T_r_c);
    step.spots.push_back(spot);
}

std::optional<slam::TLaserView> laserView(const mrpt::obs::CObservation2DRangeScan& scan) {
    const std::size_t beams = scan.getScanSize();
    if (beams < 2 || !(scan.aperture > 0) || !std::isfinite(scan.sensorPose.norm()))
        return std::nullopt;
    const mrpt::poses::CPose2D sensor(scan.sensorPose);
    slam::TLaserView view;
    view.sensor << sensor.x(), sensor.y(), sensor.phi();
    view.spacing = scan.aperture / static_cast<double>(beams - 1);
    view.first = -0.5 * scan.aperture;
    auto free = std::make_shared<std::vector<float>>();
    for (std::size_t i = 0; i < beams; ++i) {
        const std::size_t beam = scan.rightToLeft ? i : beams - 1 - i;
        free->push_back(scan.getScanRangeValidity(beam) ? scan.getScanRange(beam)
                                                        : std::numeric_limits<float>::infinity());
    }
    view.free = free;
    return view;
}

std::optional<slam::TCameraView> cameraView(
    const observations::CObservationSalientLandmarks& record, std::size_t mostPosters) {
    if (!(record.camera.fx() > 0) || record.camera.ncols == 0) return std::nullopt;
    const auto& T = record.cameraPose;
    const mrpt::math::TPoint3D ahead = T.composePoint({0, 0, 1});
    slam::TCameraView view;
    view.camera << T.x(), T.y(), std::atan2(ahead.y - T.y(), ahead.x - T.x());
    view.halfField = std::atan2(0.5 * record.camera.ncols, record.camera.fx());
    view.mostPosters = mostPosters;
    return view;
}

}  // namespace salma::apps
