// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <salma/slam/TRunRecord.h>
#include <salma/slam/TViews.h>

#include <limits>
#include <optional>
#include <vector>

namespace salma::slam {

/// Where a picture shows a measurement; NaN for what no picture shows.
struct TSpot {
    /// Its centre [px].
    mrpt::math::TPoint2D pixel{std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::quiet_NaN()};
    /// From the camera's axis to its centre, to the right [rad].
    double axisAngle{std::numeric_limits<double>::quiet_NaN()};
};

/// What a filter in space takes instead of the plane's motion and measurements.
struct TSpatialStep {
    mrpt::poses::CPose3DPDFGaussian increment;  //!< Motion since the step before, robot frame.
    mrpt::poses::CPose3D sensor;                //!< T_r_s
    std::vector<association::TMeasurement3D> measurements;  //!< In the frame of the sensor.
};

/// All that happened between the step before and this one.
struct TStepInput : TViews {
    double time{0};                           //!< [s since 1970]
    mrpt::poses::CPosePDFGaussian increment;  //!< Motion since the step before, robot frame.
    mrpt::poses::CPose2D odometry;            //!< T_o_r by odometry alone, for the record.
    std::vector<association::TMeasurement> measurements;
    std::vector<TSpot> spots;             //!< One per measurement, or none at all.
    std::optional<TSpatialStep> spatial;  //!< Only for filters in space.
};

/// How the robot really moved in a step.
struct TStepMotion {
    mrpt::poses::CPose2D motion;  //!< T_r(k-1)_r(k) after the step.
    bool isKnown{false};          //!< By landmarks, and not by odometry alone.
    /// What odometry lacked, for the wheels slipped; in the frame of the robot after the motion.
    mrpt::poses::CPose2D slip;
};

/// A way to make a trajectory and a map of measurements.
class CSlamBackend {
 public:
    virtual ~CSlamBackend() = default;

    /// \throw std::invalid_argument if `step` is not finite or its vectors' sizes do not agree.
    virtual void process(const TStepInput& step) = 0;

    /// What it made of the motion of the last step.
    virtual TStepMotion motion() const { return {}; }

    /// After the last step: puts the map into its final form.
    virtual void finish() {}

    /// T_w_r with covariance after the last step.
    virtual mrpt::poses::CPosePDFGaussian pose() const = 0;

    /// Fills trajectory, landmarks, associations, candidates and innovations of `record`.
    virtual void results(TRunRecord& record) const = 0;
};

}  // namespace salma::slam
