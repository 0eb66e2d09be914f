// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <salma/slam/TRunRecord.h>

#include <vector>

namespace salma::slam {

/// All that happened between the step before and this one.
struct TStepInput {
    double time{0};                           //!< [s since 1970]
    mrpt::poses::CPosePDFGaussian increment;  //!< Motion since the step before, robot frame.
    mrpt::poses::CPose2D odometry;            //!< T_o_r by odometry alone, for the record.
    std::vector<association::TMeasurement> measurements;
    /// Centre of each measurement in the picture [px], NaN for what no picture shows; may be empty.
    std::vector<mrpt::math::TPoint2D> pixels;
};

/// A way to make a trajectory and a map of measurements.
class CSlamBackend {
 public:
    virtual ~CSlamBackend() = default;

    /// \throw std::invalid_argument if `step` is not finite or its vectors' sizes do not agree.
    virtual void process(const TStepInput& step) = 0;

    /// T_w_r with covariance after the last step.
    virtual mrpt::poses::CPosePDFGaussian pose() const = 0;

    /// Fills trajectory, landmarks, associations, candidates and innovations of `record`.
    virtual void results(TRunRecord& record) const = 0;
};

}  // namespace salma::slam
