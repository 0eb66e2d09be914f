// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/calibration/CLaserCameraCalibrator.h>

#include <random>
#include <vector>

namespace salma::calibration {

/** A camera beside an LMS 200 in a room of 8 x 6 m, and a board held in front of both.
 *
 * Ranges have normal noise of `sigmaRange` and are too long by `offset`; corners have normal noise
 * of `sigmaPixels` on each coordinate. The camera is known exactly. */
class CSimulatedRig {
 public:
    double sigmaRange{0.005};  //!< [m]
    double sigmaPixels{0.1};   //!< [px]
    double offset{0.015};      //!< [m]
    double dark{0};            //!< [m] What dark squares add to a range.
    double tilt{1.05};  //!< [rad] Largest angle of the board to the line of sight, each axis.

    explicit CSimulatedRig(unsigned seed);

    const mrpt::img::TCamera& camera() const { return m_camera; }
    const TBoard& board() const { return m_board; }
    /// True pose of the camera in the laser's frame.
    const mrpt::poses::CPose3D& T_l_c() const { return m_T_l_c; }

    /// Pairs whose board is wholly in the picture and met by 25 beams or more.
    std::vector<TLaserBoardPair> pairs(int count);

    /// True poses T_c_b of the boards of the last call.
    const std::vector<mrpt::poses::CPose3D>& boards() const { return m_boards; }

    /// What the camera sees of a board: white with a margin of one square, before a grey wall.
    cv::Mat picture(const mrpt::poses::CPose3D& T_c_b) const;

 private:
    bool shows(const mrpt::poses::CPose3D& T_c_b, TLaserBoardPair& pair);
    int scan(const mrpt::poses::CPose3D& T_l_b, TLaserBoardPair& pair);

    mrpt::img::TCamera m_camera;
    TBoard m_board;
    mrpt::poses::CPose3D m_T_l_c;
    std::vector<mrpt::poses::CPose3D> m_boards;
    std::mt19937 m_random;
};

}  // namespace salma::calibration
