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
    /// Rotation vector and shift of T_c_l, offset, and what dark squares add to it.
    std::array<double, 8> laser{};
    std::vector<std::array<double, 6>> boards;  //!< Rotation vector and shift of each T_c_b.

    TLaserPose pose() const;
    void setPose(const TLaserPose& pose);
    double offset(bool dark) const { return laser[6] + (dark ? laser[7] : 0); }
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
              const TBoard& board,
              const std::vector<TLaserBoardPair>& pairs,
              const TLaserCameraOptions& options);

    double sigmaRange{0.01};   //!< [m]
    double sigmaPixels{0.25};  //!< [px]

    /// \param beams Of each pair. \throw std::runtime_error if it does not converge.
    void run(const std::vector<std::vector<std::size_t>>& beams, TJointState& state) const;

    /// Of state.laser, as of the last run's beams; nothing if they do not determine it.
    std::optional<Eigen::Matrix<double, 8, 8>> covariance(
        const std::vector<std::vector<std::size_t>>& beams, const TJointState& state) const;

    /// Standard deviations from the median absolute residuals.
    void estimateSigmas(const std::vector<std::vector<std::size_t>>& beams,
                        const TJointState& state);

    /// Whether a place on a board lies in a dark square. \param p In the board's frame [m].
    bool isDark(std::size_t pair, const Eigen::Vector3d& p) const;

    /// Whether a beam meets a dark square. \param state Says where it meets the board.
    bool meetsDark(std::size_t pair, std::size_t beam, const TJointState& state) const;

    /// Measured minus expected range [m].
    double rangeResidual(std::size_t pair, std::size_t beam, const TJointState& state) const;

 private:
    struct TProblem;

    const mrpt::img::TCamera& m_camera;
    std::vector<mrpt::math::TPoint2D> m_board;
    double m_square;  //!< [m]
    const std::vector<TLaserBoardPair>& m_pairs;
    bool m_estimateOffset, m_estimateDark;
};

}  // namespace salma::calibration
