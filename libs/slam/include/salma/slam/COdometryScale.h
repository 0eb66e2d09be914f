// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/poses/CPose2D.h>
#include <salma/slam/COdometryNoise.h>
#include <salma/slam/CSlamBackend.h>

namespace salma::slam {

/** Learns how many metres a metre of odometry is.
 *
 * Wheels wear and are not as large as stated. Unlike noise, such an error grows with distance, so
 * it decides where a robot is that crosses a hall without landmarks. Where landmarks are tracked
 * they tell the length of a stretch; each stretch is a measurement of the scale, whose error is the
 * noise of odometry over it. Kalman filter of one number. Source: own; the scale as a parameter of
 * odometry in Borenstein and Feng, IEEE T-RA 12(6), 1996. */
class COdometryScale {
 public:
    explicit COdometryScale(const TOdometryOptions& options = {});

    /// A motion as it probably was. \param odometry T_r(k-1)_r(k), as read.
    mrpt::poses::CPose2D corrected(const mrpt::poses::CPose2D& odometry) const;

    /// \param odometry As read. \param step What the filter made of it.
    void learn(const mrpt::poses::CPose2D& odometry, const TStepMotion& step);

    double excess() const { return m_excess; }  //!< True length / length by odometry - 1.
    double sigma() const;                       //!< Of it.

 private:
    void begin();
    void measure(double excess, double length);

    double m_alongPerMetre;
    double m_excess{0}, m_variance{0};
    bool m_isOpen{false};  //!< The stretch began where landmarks told the place.
    mrpt::poses::CPose2D m_odometry, m_motion;  //!< Since it began.
    double m_unseen{0};                         //!< Travel since landmarks last told the place [m].
};

}  // namespace salma::slam
