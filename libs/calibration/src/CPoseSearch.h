// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <mrpt/poses/CPose3D.h>
#include <salma/calibration/CLaserCameraCalibrator.h>

#include <cstddef>
#include <optional>
#include <vector>

#include "TLaserPose.h"

namespace salma::calibration {

/// A straight piece of a scan that may be the board [m, laser frame].
struct TScanPiece {
    mrpt::math::TPoint2D from, to;
};

/// One board, and what of the scan may lie on it.
struct TBoardInScan {
    TPlane plane;
    Eigen::Vector3d centre{Eigen::Vector3d::Zero()};  //!< Of the board, in the camera's frame [m].
    double radius{0};                                 //!< From there to its corners [m].
    std::vector<TScanPiece> pieces;
};

/// Straight pieces that are no longer than a board of this radius and no farther from its centre
/// than the camera's distance from the laser allows.
std::vector<TScanPiece> piecesOf(const TRangeScan& scan,
                                 const TBoardInScan& board,
                                 const TLaserCameraOptions& options);

/** The pose of the laser that most boards agree with, found from random samples.
 * \return Nothing if fewer than `min_pairs` agree with any. Deterministic. */
class CPoseSearch {
 public:
    CPoseSearch(const std::vector<TBoardInScan>& boards, const TLaserCameraOptions& options)
        : m_boards(boards), m_options(options) {}

    std::optional<TLaserPose> find() const;

 private:
    /// The piece of each board that fits best, where one agrees; and how many do.
    struct TAgreement {
        std::vector<std::optional<std::size_t>> piece;
        std::size_t count{0};
        double misfit{0};  //!< [m] Summed over those that agree.

        bool isBetterThan(const TAgreement& other) const {
            return count > other.count || (count == other.count && misfit < other.misfit);
        }
    };

    TAgreement agreement(const TLaserPose& pose) const;
    void polish(TLaserPose& pose, TAgreement& with) const;

    const std::vector<TBoardInScan>& m_boards;
    const TLaserCameraOptions& m_options;
};

}  // namespace salma::calibration
