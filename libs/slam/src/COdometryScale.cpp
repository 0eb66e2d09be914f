// SPDX-License-Identifier: BSD-3-Clause
#include <salma/slam/COdometryScale.h>

#include <cmath>

namespace salma::slam {

namespace {

constexpr double stretch = 1;       // its length is one measurement [m]
constexpr double longestGap = 0.5;  // of travel without landmarks inside it [m]
constexpr double gate = 9;          // of the squared innovation: a stretch with a slip is none

}  // namespace

COdometryScale::COdometryScale(const TOdometryOptions& options)
    : m_alongPerMetre(options.alongPerMetre), m_variance(options.scaleSigma * options.scaleSigma) {}

double COdometryScale::sigma() const { return std::sqrt(m_variance); }

mrpt::poses::CPose2D COdometryScale::corrected(const mrpt::poses::CPose2D& odometry) const {
    return {(1 + m_excess) * odometry.x(), (1 + m_excess) * odometry.y(), odometry.phi()};
}

void COdometryScale::begin() {
    m_isOpen = true;
    m_unseen = 0;
    m_odometry = m_motion = {};
}

void COdometryScale::learn(const mrpt::poses::CPose2D& odometry, const TStepMotion& step) {
    m_odometry = m_odometry + odometry;
    m_motion = m_motion + step.motion;
    m_unseen += odometry.norm();
    if (step.slip.norm() > 0 || m_unseen > longestGap) m_isOpen = false;
    if (!step.isKnown) return;
    m_unseen = 0;
    const double length = m_odometry.norm();
    if (m_isOpen && length < stretch) return;
    if (m_isOpen) measure(m_motion.norm() / length - 1, length);
    begin();
}

/// One stretch: a Kalman update of the scale.
void COdometryScale::measure(double excess, double length) {
    const double innovation = excess - m_excess;
    const double noise = m_alongPerMetre * m_alongPerMetre / length;
    const double S = m_variance + noise;
    if (!(innovation * innovation <= gate * S)) return;
    m_excess += m_variance / S * innovation;
    m_variance *= noise / S;
}

}  // namespace salma::slam
