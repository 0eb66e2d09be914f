// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>
#include <salma/simulator/TSensorOptions.h>

#include <cstdint>
#include <memory>
#include <optional>

namespace salma::simulator {

class CRandom;

/** Wheel odometry: sums up increments of the true motion, each with errors.
 *
 * With d the distance and a the turn of one increment, and s = TOdometryOptions::factor() times the
 * sigma of that name:
 *   d' = d (1 + scale) + N(0, s_distance sqrt|d|),
 *   a' = a (1 + turn_scale) + drift |d| + N(0, s_heading sqrt|d|) + N(0, s_turn sqrt|a|),
 * where scale, turn_scale and drift are drawn once. With probability slips_per_m |d| a wheel slips
 * in the increment, which adds N(0, s_slip) to d' and N(0, s_slip_turn) to a'. Source: own, after
 * the usual velocity model. */
class COdometryModel {
 public:
    COdometryModel(const TOdometryOptions& options, std::uint32_t seed);
    ~COdometryModel();
    COdometryModel(const COdometryModel&) = delete;
    COdometryModel& operator=(const COdometryModel&) = delete;

    /// T_o_r after the robot has moved to `T_w_r`; the identity at the first call.
    mrpt::math::TPose2D next(const mrpt::math::TPose2D& T_w_r);

 private:
    TOdometryOptions m_options;
    std::unique_ptr<CRandom> m_random, m_slips;
    double m_scale, m_turnScale, m_drift;
    std::optional<mrpt::math::TPose2D> m_last;  //!< T_w_r of the last call.
    mrpt::math::TPose2D m_pose;
};

}  // namespace salma::simulator
