// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/simulator/CCameraModel.h>
#include <salma/simulator/CWorld.h>

#include <opencv2/core/mat.hpp>
#include <utility>
#include <vector>

namespace salma::simulator {

/// What an ideal camera sees.
struct TRendering {
    cv::Mat_<cv::Vec3f> colour;    //!< Blue, green, red, 0..255.
    cv::Mat_<float> inverseDepth;  //!< 1 / distance along the optical axis [1/m]; 0: nothing hit.
};

/** Draws the faces of a world as a camera sees them.
 *
 * Every pixel's own ray is cut with the faces, so that lens distortion is exact; textures are
 * filtered over the pixel's footprint, and pixels on the edge of a face are sampled 16 times. */
class CRenderer {
 public:
    /// Both must outlive this object.
    CRenderer(const CWorld& world, const CCameraModel& camera);

    /// \param T_w_c Pose of the camera's optical frame. Safe to call from several threads.
    TRendering render(const mrpt::poses::CPose3D& T_w_c) const;

 private:
    class CFrame;  //!< One picture in the making.
    struct TBound {
        float low, high;
    };
    /// First and last of the bounds that meet [low, high]; the last before the first if none does.
    static std::pair<int, int> touched(const std::vector<TBound>& bounds, float low, float high);

    const CWorld& m_world;
    const CCameraModel& m_camera;
    std::vector<TBound> m_rowBounds;     //!< y/z of each row of pixels.
    std::vector<TBound> m_columnBounds;  //!< x/z of each column of pixels.
};

}  // namespace salma::simulator
