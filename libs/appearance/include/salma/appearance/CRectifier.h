// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/core/bits_math.h>
#include <salma/appearance/CWallView.h>
#include <salma/config/TStrictOptions.h>
#include <salma/observations/TPatch.h>

#include <opencv2/core/mat.hpp>
#include <optional>
#include <utility>

namespace salma::appearance {

/// Section [rectification] of config.ini.
struct TRectificationOptions : public config::TStrictOptions<TRectificationOptions> {
    double minPixelsPerMetre{40};   //!< Coarser views are refused [px/m].
    double maxPixelsPerMetre{400};  //!< Finer views are reduced to this [px/m].
    double maxOutside{0.1};         //!< Share of a rectangle that may lie outside the picture.
    double maxIncidence{mrpt::DEG2RAD(75.0)};  //!< Views more slanting are refused [rad].
    double minSize{0.05};                      //!< Smallest width and height of a patch [m].
    double maxSize{4};                         //!< Largest width and height of a patch [m].
    double cameraSigma{1};                     //!< Noise of the patch's place in the picture [px].
    double extrinsicsSigma{
        mrpt::DEG2RAD(0.5)};          //!< Of each angle of the camera on the robot [rad].
    double extrinsicsSigmaXyz{0.01};  //!< Of each coordinate of the camera [m].
    double wallSigma{0.01};           //!< Of rho beside the line's own: poster frames [m].
    double heightSigma{0.05};         //!< Of z beside what the ray gives: floor, suspension [m].
    double tiltSigma{
        mrpt::DEG2RAD(1.0)};  //!< Of the patch's pitch and roll: walls out of plumb [rad].

    void visit(config::COptionVisitor& v);
    void validate() const;
};

/// Part of a wall, in wall coordinates of CWallView [m].
struct TWallRectangle {
    double u0{0}, v0{0};  //!< Lower left corner.
    double u1{0}, v1{0};  //!< Upper right corner.
};

enum class ERefusal {
    none,            //!< There is a patch.
    noPicture,       //!< The picture is empty, or not of the camera's size.
    badWall,         //!< The wall line's covariance is not finite.
    badRectangle,    //!< Empty, not finite, too small or too large.
    outsidePicture,  //!< More than `outside_max` of it out of the picture, or behind the camera.
    grazing,         //!< More slanting than `incidence_max_deg`.
    coarse           //!< Surely (by two sigmas) fewer pixels per metre than `px_per_m_min`.
};

/// The reason in words, e.g. "grazing".
const char* asString(ERefusal reason);

struct TRectification {
    std::optional<observations::TPatch> patch;
    ERefusal refusal{ERefusal::none};
};

/** Cuts a rectangle of a wall out of a picture as one would see it from straight ahead.
 *
 * The patch's resolution is that of the view at the rectangle's coarser axis and place, at most
 * `px_per_m_max`; sampling averages over the pixel's area. Where a rectangle reaches out of the
 * picture by no more than `outside_max`, the patch keeps its whole extent, and the last pixels that
 * are seen are repeated there. Its pose comes from the ray of the
 * centre meeting the wall: covariance from the line's (rho, alpha), from the pixel, and from the
 * camera's place on the robot; pitch and roll, which a vertical wall does not measure, carry the
 * prior of the options, and so does z in addition to what the ray gives. */
class CRectifier {
 public:
    /// \throw std::invalid_argument if the options contradict each other.
    explicit CRectifier(const TRectificationOptions& options = {});

    /** \param grey [rows x cols], 8 bit, one channel, distorted as the camera delivers it.
     * \return The patch without regions, keypoints and texture, or the reason of the refusal.
     * \throw std::invalid_argument if `grey` is not of type CV_8UC1. */
    TRectification rectify(const cv::Mat& grey,
                           const CWallView& view,
                           const TWallRectangle& rectangle) const;

    /// Pose of a patch centred at (u, v) with its covariance (x, y, z, yaw, pitch, roll), robot
    /// frame. The point must be visible.
    mrpt::poses::CPose3DPDFGaussian pose(const CWallView& view, double u, double v) const;

    const TRectificationOptions& options() const { return m_options; }

 private:
    ERefusal check(const cv::Mat& grey, const CWallView& view, const TWallRectangle& r) const;
    /// `resolution` along u and v [px/m], wrong as far as the patch's pose is.
    bool surelyCoarse(const observations::TPatch& patch,
                      const std::pair<double, double>& resolution) const;

    TRectificationOptions m_options;
};

}  // namespace salma::appearance
