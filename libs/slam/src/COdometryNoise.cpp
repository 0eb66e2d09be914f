// SPDX-License-Identifier: BSD-3-Clause
#include <salma/slam/COdometryNoise.h>

#include <cmath>

namespace salma::slam {

void TOdometryOptions::visit(config::COptionVisitor& v) {
    v.number("along_per_metre_m", alongPerMetre, config::atLeast(0),
             "standard deviation along the path after one metre, growing with its square root");
    v.number("across_per_metre_m", acrossPerMetre, config::atLeast(0),
             "standard deviation sideways after one metre");
    v.number("scale_sigma", scaleSigma, config::between(0, 0.5),
             "standard deviation of the length of a metre, learned from landmarks; 0: not learned");
    v.degrees("heading_per_metre_deg", headingPerMetre, config::atLeast(0),
              "standard deviation of the heading after one metre");
    v.degrees("heading_per_radian_deg", headingPerRadian, config::atLeast(0),
              "standard deviation of the heading after one radian of turning");
    v.number("min_position_m", minPosition, config::atLeast(0),
             "standard deviation added in each step with motion");
    v.degrees("min_heading_deg", minHeading, config::atLeast(0),
              "standard deviation of the heading added in each step with motion");
}

COdometryNoise::COdometryNoise(const TOdometryOptions& options) : m_options(options) {}

mrpt::poses::CPosePDFGaussian COdometryNoise::increment(const mrpt::poses::CPose2D& motion) const {
    const auto square = [](double sigma) { return sigma * sigma; };
    const double distance = std::hypot(motion.x(), motion.y());
    const double turn = std::abs(motion.phi());
    mrpt::poses::CPosePDFGaussian result;
    result.mean = motion;
    result.cov.setZero();
    if (distance == 0 && turn == 0) return result;
    const double along = square(m_options.alongPerMetre) * distance + square(m_options.minPosition);
    const double across =
        square(m_options.acrossPerMetre) * distance + square(m_options.minPosition);
    // Along is the direction of the displacement; a robot that only turns has
    // none, but then both variances are equal.
    const double c = distance > 0 ? motion.x() / distance : 1;
    const double s = distance > 0 ? motion.y() / distance : 0;
    result.cov(0, 0) = c * c * along + s * s * across;
    result.cov(1, 1) = s * s * along + c * c * across;
    result.cov(0, 1) = result.cov(1, 0) = c * s * (along - across);
    result.cov(2, 2) = square(m_options.headingPerMetre) * distance +
                       square(m_options.headingPerRadian) * turn + square(m_options.minHeading);
    return result;
}

}  // namespace salma::slam
