// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/core/bits_math.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <salma/config/TStrictOptions.h>

namespace salma::slam {

/// Section [odometry] of config.ini: standard deviations after one metre and after one radian.
struct TOdometryOptions : public config::TStrictOptions<TOdometryOptions> {
    double alongPerMetre{0.12};   //!< In the direction of travel, after one metre [m].
    double acrossPerMetre{0.02};  //!< Sideways, after one metre [m].
    double scaleSigma{0.05};      //!< Of the length of a metre before it is learned; 0: it is not.
    double headingPerMetre{mrpt::DEG2RAD(1.5)};   //!< After one metre [rad].
    double headingPerRadian{mrpt::DEG2RAD(2.5)};  //!< After one radian of turning [rad].
    double minPosition{1e-4};                 //!< Added in each step in which the robot moves [m].
    double minHeading{mrpt::DEG2RAD(0.005)};  //!< The same for the heading [rad].

    void visit(config::COptionVisitor& v);
};

/** Covariance of a motion increment for logs that state none.
 *
 * Errors are a random walk: variances, not deviations, grow with distance and angle, so that the
 * drift over a path does not depend on how many steps it is cut into (Thrun's sigma = alpha * d
 * shrinks when steps get shorter). A robot at rest gets no error at all. Source: own. */
class COdometryNoise {
 public:
    explicit COdometryNoise(const TOdometryOptions& options = {});

    /// \param motion T_r(k-1)_r(k). \return It with its covariance in the frame r(k-1) [m, rad].
    mrpt::poses::CPosePDFGaussian increment(const mrpt::poses::CPose2D& motion) const;

 private:
    TOdometryOptions m_options;
};

}  // namespace salma::slam
