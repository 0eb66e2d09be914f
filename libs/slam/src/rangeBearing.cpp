// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <mrpt/poses/CPose2D.h>
#include <salma/slam/rangeBearing.h>

#include <Eigen/Core>
#include <cmath>
#include <stdexcept>

namespace salma::slam {
namespace {

/// Covariance of range, yaw and pitch.
Eigen::Matrix3d noise(const mrpt::obs::CObservationBearingRange& record,
                      std::size_t index,
                      const TRangeBearingOptions& options) {
    if (record.validCovariances) return record.sensedData[index].covariance.asEigen();
    const auto stated = [](double inRecord, double byOptions) {
        return inRecord > 0 ? inRecord : byOptions;
    };
    return Eigen::Vector3d(stated(record.sensor_std_range, options.sigmaRange),
                           stated(record.sensor_std_yaw, options.sigmaBearing),
                           stated(record.sensor_std_pitch, options.sigmaPitch))
        .cwiseAbs2()
        .asDiagonal();
}

[[noreturn]] void fail(const mrpt::obs::CObservationBearingRange& record,
                       std::size_t index,
                       const std::string& problem) {
    throw std::invalid_argument("Range-bearing sensor '" + record.sensorLabel + "', landmark " +
                                std::to_string(index) + ": " + problem);
}

/// \throw std::invalid_argument
void checkSensed(const mrpt::obs::CObservationBearingRange& record, std::size_t index) {
    const auto& sensed = record.sensedData[index];
    if (!(sensed.range > 0) || !std::isfinite(sensed.range) || !std::isfinite(sensed.yaw))
        fail(record, index,
             "range " + std::to_string(sensed.range) + " m, bearing " + std::to_string(sensed.yaw) +
                 " rad");
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
    v.degrees("sigma_pitch_deg", sigmaPitch, config::moreThan(0),
              "standard deviation of the pitch where the record states none (6d)");
}

std::vector<association::TMeasurement> measurementsOf(
    const mrpt::obs::CObservationBearingRange& record, const TRangeBearingOptions& options) {
    const mrpt::poses::CPose2D sensor(record.sensorLocationOnRobot);
    std::vector<association::TMeasurement> result;
    for (std::size_t i = 0; i < record.sensedData.size(); ++i) {
        const auto& sensed = record.sensedData[i];
        checkSensed(record, i);
        if (!(sensed.pitch == 0))
            fail(record, i,
                 "pitch " + std::to_string(sensed.pitch) +
                     " rad, but the filter is planar (state = 6d in [ekf] is not)");
        association::TMeasurement measurement;
        measurement.z << sensed.range, mrpt::math::wrapToPi(static_cast<double>(sensed.yaw));
        measurement.R = noise(record, i, options).topLeftCorner<2, 2>();
        if (sensed.landmarkID >= 0) measurement.identity = sensed.landmarkID;
        toRobotFrame(sensor, measurement);
        result.push_back(measurement);
    }
    return result;
}

std::vector<association::TMeasurement3D> spatialMeasurementsOf(
    const mrpt::obs::CObservationBearingRange& record, const TRangeBearingOptions& options) {
    std::vector<association::TMeasurement3D> result;
    for (std::size_t i = 0; i < record.sensedData.size(); ++i) {
        const auto& sensed = record.sensedData[i];
        checkSensed(record, i);
        if (!(std::abs(sensed.pitch) < M_PI / 2))
            fail(record, i, "pitch " + std::to_string(sensed.pitch) + " rad");
        association::TMeasurement3D measurement;
        measurement.z << sensed.range, mrpt::math::wrapToPi(static_cast<double>(sensed.yaw)),
            sensed.pitch;
        measurement.R = noise(record, i, options);
        if (sensed.landmarkID >= 0) measurement.identity = sensed.landmarkID;
        result.push_back(measurement);
    }
    return result;
}

}  // namespace salma::slam
