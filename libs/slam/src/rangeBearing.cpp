// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <mrpt/poses/CPose2D.h>
#include <salma/slam/rangeBearing.h>

#include <Eigen/Core>
#include <cmath>
#include <stdexcept>

namespace salma::slam {
namespace {

Eigen::Matrix2d noise(const mrpt::obs::CObservationBearingRange& record,
                      std::size_t index,
                      const TRangeBearingOptions& options) {
    if (record.validCovariances)
        return record.sensedData[index].covariance.asEigen().topLeftCorner<2, 2>();
    const double range = record.sensor_std_range > 0 ? record.sensor_std_range : options.sigmaRange;
    const double bearing = record.sensor_std_yaw > 0 ? record.sensor_std_yaw : options.sigmaBearing;
    return Eigen::Vector2d(range * range, bearing * bearing).asDiagonal();
}

/// Range and bearing from the robot's origin instead of the sensor's.
void toRobotFrame(const mrpt::poses::CPose2D& sensor, association::TMeasurement& measurement) {
    const double range = measurement.z[0];
    const double direction = measurement.z[1] + sensor.phi();
    const Eigen::Vector2d ray(std::cos(direction), std::sin(direction));
    const Eigen::Vector2d point = Eigen::Vector2d(sensor.x(), sensor.y()) + range * ray;
    const double fromRobot = point.norm();
    measurement.z << fromRobot, std::atan2(point[1], point[0]);
    Eigen::Matrix2d pointByOld;
    pointByOld << ray[0], -range * ray[1], ray[1], range * ray[0];
    Eigen::Matrix2d newByPoint;
    newByPoint << point[0] / fromRobot, point[1] / fromRobot, -point[1] / (fromRobot * fromRobot),
        point[0] / (fromRobot * fromRobot);
    const Eigen::Matrix2d newByOld = newByPoint * pointByOld;
    measurement.R = newByOld * measurement.R * newByOld.transpose();
}

}  // namespace

void TRangeBearingOptions::visit(config::COptionVisitor& v) {
    v.number("sigma_range_m", sigmaRange, config::moreThan(0),
             "standard deviation of the range where the record states none");
    v.degrees("sigma_bearing_deg", sigmaBearing, config::moreThan(0),
              "standard deviation of the bearing where the record states none");
}

std::vector<association::TMeasurement> measurementsOf(
    const mrpt::obs::CObservationBearingRange& record, const TRangeBearingOptions& options) {
    const mrpt::poses::CPose2D sensor(record.sensorLocationOnRobot);
    std::vector<association::TMeasurement> result;
    for (std::size_t i = 0; i < record.sensedData.size(); ++i) {
        const auto& sensed = record.sensedData[i];
        const auto fail = [&](const std::string& problem) {
            throw std::invalid_argument("Range-bearing sensor '" + record.sensorLabel +
                                        "', landmark " + std::to_string(i) + ": " + problem);
        };
        if (!(sensed.range > 0) || !std::isfinite(sensed.range) || !std::isfinite(sensed.yaw))
            fail("range " + std::to_string(sensed.range) + " m, bearing " +
                 std::to_string(sensed.yaw) + " rad");
        if (!(sensed.pitch == 0))
            fail("pitch " + std::to_string(sensed.pitch) + " rad, but the filter is planar");
        association::TMeasurement measurement;
        measurement.z << sensed.range, mrpt::math::wrapToPi(static_cast<double>(sensed.yaw));
        measurement.R = noise(record, i, options);
        if (sensed.landmarkID >= 0) measurement.identity = sensed.landmarkID;
        toRobotFrame(sensor, measurement);
        result.push_back(measurement);
    }
    return result;
}

}  // namespace salma::slam
