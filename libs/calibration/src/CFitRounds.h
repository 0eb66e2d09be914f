// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/calibration/CLaserCameraCalibrator.h>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "CJointFit.h"

namespace salma::calibration {

/// The part of the board's plane that is used, in its own frame [m].
struct TOutline {
    double left{0}, right{0}, top{0}, bottom{0};

    TOutline(const std::vector<mrpt::math::TPoint2D>& points, double margin);
    bool contains(const Eigen::Vector3d& p) const {
        return p.x() >= left && p.x() <= right && p.y() >= top && p.y() <= bottom;
    }
};

/// Which beams end on which board, and the fit to them, again and again until both stay.
class CFitRounds {
 public:
    using TBeams = std::vector<std::vector<std::size_t>>;

    /// All must outlive this object.
    CFitRounds(const TLaserCameraOptions& options,
               const TOutline& outline,
               const std::vector<TLaserBoardPair>& pairs,
               CJointFit& fit)
        : m_options(options), m_outline(outline), m_pairs(pairs), m_fit(fit) {}

    /// Beams that should meet the board inside of the outline and end no farther than `limit` [m]
    /// from its plane; none if they are fewer than `min_points` or fewer than half.
    std::vector<std::size_t> beamsOn(std::size_t pair,
                                     const TJointState& state,
                                     double limit) const;

    /// \param use Pairs that take part. \return Their beams.
    /// \throw std::runtime_error if fewer than `min_pairs` have any.
    TBeams run(const std::vector<bool>& use, TJointState& state) const;

 private:
    const TLaserCameraOptions& m_options;
    const TOutline& m_outline;
    const std::vector<TLaserBoardPair>& m_pairs;
    CJointFit& m_fit;
};

}  // namespace salma::calibration
