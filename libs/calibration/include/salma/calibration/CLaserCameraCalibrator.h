// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/poses/CPose3D.h>
#include <salma/calibration/TBoard.h>
#include <salma/calibration/TRangeScan.h>
#include <salma/config/TStrictOptions.h>

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace salma::calibration {

/// Section [laser_camera].
struct TLaserCameraOptions : public config::TStrictOptions<TLaserCameraOptions> {
    double maxBaseline{1};      //!< [m] The laser stands no farther from the camera.
    double margin{0.5};         //!< [squares] What of the board around the corners is used.
    double tolerance{0.05};     //!< [m] A line of the scan this near the board's plane agrees.
    double gate{4};             //!< [sigma] Farther from the plane, a point is not used.
    int samples{5000};          //!< Random starts.
    int minPairs{5};            //!< Of pictures and scans that agree.
    int minPoints{8};           //!< Of a scan, on one board.
    bool estimateDark{true};    //!< A further offset on dark squares, where their places are known.
    bool estimateOffset{true};  //!< Of all ranges, as the LMS 200 has it.
    int folds{5};               //!< Blocks of pairs that are left out, each once.
    int seed{1};                //!< Of the random starts.

    void visit(config::COptionVisitor& v);
};

/// A board in a picture, and the scan taken at that moment.
struct TLaserBoardPair {
    std::string name;                          //!< For messages; the picture's file.
    std::vector<mrpt::math::TPoint2D> pixels;  //!< The board's points [px].
    TRangeScan scan;
    /// firstSquareIsDark(), of a chessboard. Without it, dark squares are ranged as bright ones.
    std::optional<bool> firstIsDark;
};

/// What became of one pair.
struct TPairFit {
    bool used{false};                //!< Its scan agrees with its picture.
    mrpt::poses::CPose3D T_c_b;      //!< The board.
    std::vector<std::size_t> beams;  //!< Of the scan, on the board.
    /// [m] Of ends of beams from the board's plane as the picture alone shows it, all within twice
    /// the tolerance.
    std::vector<double> distances;
    std::vector<double> heldOutDistances;  //!< [m] The same with the pose of the other folds.
};

struct TLaserCameraCalibration {
    mrpt::poses::CPose3D T_l_c;  //!< Optical frame of the camera in the laser's frame.
    double rangeOffset{0};       //!< [m] Measured minus true range.
    double darkOffset{0};        //!< [m] What dark squares add to it.
    double sigmaDark{0};         //!< [m]
    /// Of (x, y, z, yaw, pitch, roll) of T_l_c and the offset [m, rad].
    Eigen::Matrix<double, 7, 7> covariance{Eigen::Matrix<double, 7, 7>::Zero()};
    double sigmaRange{0};   //!< [m] Of one range, from the residuals.
    double sigmaPixels{0};  //!< [px] Of one coordinate of a corner, from the residuals.
    std::vector<TPairFit> pairs;

    std::size_t usedPairs() const;
    /// Of the distances without their sign [m]; NaN if there are none.
    double medianFitted() const;
    double medianHeldOut() const;
};

/** The pose of a camera beside a 2-D laser, from boards that both see.
 *
 * Each end of a beam on a board lies in the board's plane as the camera sees it. A linear start
 * from five lines drawn at random (of all straight pieces of each scan: which is the board need not
 * be told), the pose that most pairs agree with, then maximum likelihood over the pose, the offset
 * of the ranges and the poses of the boards, with a robust loss (Ceres). Some scanners range dark
 * squares differently: a second offset takes that out. The camera's own intrinsics are taken as
 * exact. The noise of ranges and corners is estimated with it.
 * Source: Q. Zhang and R. Pless, "Extrinsic calibration of a camera and laser range finder", IROS
 * 2004; the joint estimate with the boards' poses and the second offset are own. */
class CLaserCameraCalibrator {
 public:
    explicit CLaserCameraCalibrator(const TLaserCameraOptions& options = {});

    /** Deterministic: same pairs and seed, same result.
     * \throw std::invalid_argument if a pair has no points for the board or numbers that are not
     * finite; std::runtime_error if fewer than `min_pairs` agree on a pose or they do not
     * determine it. */
    TLaserCameraCalibration calibrate(const mrpt::img::TCamera& camera,
                                      const TBoard& board,
                                      const std::vector<TLaserBoardPair>& pairs) const;

 private:
    TLaserCameraOptions m_options;
};

}  // namespace salma::calibration
