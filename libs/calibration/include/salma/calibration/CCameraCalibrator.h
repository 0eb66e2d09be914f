// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/math/TPoint2D.h>
#include <mrpt/poses/CPose3D.h>
#include <salma/config/TStrictOptions.h>

#include <Eigen/Core>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

namespace salma::calibration {

/// What of the lens is estimated, and how it is tried.
struct TCameraCalibrationOptions : public config::TStrictOptions<TCameraCalibrationOptions> {
    int radialTerms{2};     //!< k1, k2, k3: how many of them.
    bool tangential{true};  //!< p1, p2.
    int folds{5};           //!< Blocks of neighbouring pictures that are left out, each once.

    void visit(config::COptionVisitor& v);
};

/// One picture's points, beside the board's own.
struct TBoardView {
    std::string name;                          //!< For messages; the picture's file.
    std::vector<mrpt::math::TPoint2D> pixels;  //!< [px]
};

/// Distances between where points were seen and where they should be seen.
struct TViewResiduals {
    std::vector<mrpt::math::TPoint2D> errors;  //!< Seen minus expected [px], one for each point.
    double rms{0};                             //!< Root of the mean squared distance [px].
};

struct TCameraCalibration {
    mrpt::img::TCamera camera;
    /// Of fx, fy, cx, cy, k1, k2, p1, p2, k3 [px, 1]; 0 for those that were not estimated.
    Eigen::Matrix<double, 9, 9> covariance;
    double sigmaPixels{0};                    //!< Of one coordinate, from the residuals.
    std::vector<mrpt::poses::CPose3D> T_c_b;  //!< Pose of each board.
    std::vector<TViewResiduals> fitted;       //!< Of each view in the fit of all.
    /** Of each view with the camera of the other blocks; its own points gave only the board's pose.
     * Empty where too few boards are left. */
    std::vector<TViewResiduals> heldOut;

    static double rmsOf(const std::vector<TViewResiduals>& views);
};

/** Intrinsics and distortion from pictures of a flat board.
 * Source: Z. Zhang, "A flexible new technique for camera calibration", PAMI 22(11), 2000, as
 * OpenCV has it; covariance from the normal equations with the boards' poses eliminated. */
class CCameraCalibrator {
 public:
    explicit CCameraCalibrator(const TCameraCalibrationOptions& options = {});

    /** \param board Points on the board [m], in the order of each view's pixels.
     * \param size Of all pictures [px].
     * \throw std::invalid_argument for fewer than three views, a view of another number of points
     * or with numbers that are not finite; std::runtime_error if the views do not determine the
     * camera, as when all boards are parallel. */
    TCameraCalibration calibrate(const std::vector<mrpt::math::TPoint2D>& board,
                                 const std::vector<TBoardView>& views,
                                 const cv::Size& size) const;

 private:
    TCameraCalibrationOptions m_options;
};

/** The pose of a board that a calibrated camera sees, and how well it fits.
 * \return Nothing if the points determine none in front of the camera. */
struct TBoardPose {
    mrpt::poses::CPose3D T_c_b;
    TViewResiduals residuals;
};
std::optional<TBoardPose> locateBoard(const mrpt::img::TCamera& camera,
                                      const std::vector<mrpt::math::TPoint2D>& board,
                                      const std::vector<mrpt::math::TPoint2D>& pixels);

}  // namespace salma::calibration
