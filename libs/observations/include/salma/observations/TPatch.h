// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/CImage.h>
#include <mrpt/math/TPoint2D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <salma/observations/TSalientRegion.h>

#include <array>
#include <cstdint>
#include <vector>

namespace salma::observations {

/// A SIFT keypoint on a wall patch, in the patch frame (u right, v up, origin at the centre).
struct TKeypoint {
    double x{0};      //!< Along u [m].
    double y{0};      //!< Along v [m].
    double scale{0};  //!< Diameter of the keypoint's neighbourhood [m].
    double angle{0};  //!< Orientation, counter-clockwise from u [rad].
    std::array<std::uint8_t, 128> descriptor{};
};

/** A piece of wall as one would see it from straight ahead: what salma remembers of a landmark.
 *
 * The patch frame p has its origin at the centre of the rectangle, u to the right and v up as one
 * faces the wall, and the normal towards the robot; see docs/frames.md. */
struct TPatch {
    /// Corners in the source picture [px]: top left, top right, bottom right, bottom left.
    std::array<mrpt::math::TPoint2D, 4> quad{};
    /// T_r_p: pose of the patch in the robot frame at the picture's time, with its covariance [m,
    /// rad].
    mrpt::poses::CPose3DPDFGaussian pose;
    double width{0};           //!< Along u [m].
    double height{0};          //!< Along v [m].
    double pixelsPerMetre{0};  //!< Resolution of `picture` [px/m].
    mrpt::img::CImage
        picture;  //!< Grey, first row at the top; owned, never a view of another image.
    /// In the patch frame: x along u, y along v, s in metres [m]. Most salient first.
    std::vector<TSalientRegion> regions;
    std::vector<TKeypoint> keypoints;
    std::vector<float> texture;  //!< Histogram of the wall around the entity; empty: not described.
    double incidence{
        0};  //!< Angle between the ray to the centre and the wall's normal, [0, pi/2) [rad].
};

}  // namespace salma::observations
