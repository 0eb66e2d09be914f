// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/TCamera.h>
#include <salma/calibration/CLaserCameraCalibrator.h>

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "TLaserPose.h"

namespace salma::calibration {

/// What the maximum-likelihood fit changes.
struct TJointState {
    std::array<double, 7> laser{};              //!< Rotation vector and shift of T_c_l, offset.
    std::vector<std::array<double, 6>> boards;  //!< Rotation vector and shift of each T_c_b.

    TLaserPose pose() const;
    void setPose(const TLaserPose& pose);
    double offset() const { return laser[6]; }
    TPlane plane(std::size_t board) const;
    /// A point of the camera's frame in the frame of a board [m].
    Eigen::Vector3d onBoard(std::size_t board, const Eigen::Vector3d& X) const;
};

/** Pose of the laser, offset and boards together, from corners and ranges.
 *
 * Corners count in every pair, ranges where a pair has beams. Residuals are divided by their
 * standard deviations and weighed down beyond 3 of them (Huber). */
class CJointFit {
 public:
    CJointFit(const mrpt::img::TCamera& camera,
              const std::vector<mrpt::math::TPoint2D>& board,
              const std::vector<TLaserBoardPair>& pairs,
              bool estimateOffset);

    double sigmaRange{0.01};   //!< [m]
    double sigmaPixels{0.25};  //!< [px]

    /// \param beams Of each pair. \throw std::runtime_error if it does not converge.
    void run(const std::vector<std::vector<std::size_t>>& beams, TJointState& state) const;

    /// Of state.laser, as of the last run's beams; nothing if they do not determine it.
    std::optional<Eigen::Matrix<double, 7, 7>> covariance(
        const std::vector<std::vector<std::size_t>>& beams, const TJointState& state) const;

    /// Standard deviations from the median absolute residuals.
    void estimateSigmas(const std::vector<std::vector<std::size_t>>& beams,
                        const TJointState& state);

    /// Measured minus expected range [m].
    double rangeResidual(std::size_t pair, std::size_t beam, const TJointState& state) const;

 private:
    struct TProblem;

    const mrpt::img::TCamera& m_camera;
    const std::vector<mrpt::math::TPoint2D>& m_board;
    const std::vector<TLaserBoardPair>& m_pairs;
    bool m_estimateOffset;
};

}  // namespace salma::calibration
