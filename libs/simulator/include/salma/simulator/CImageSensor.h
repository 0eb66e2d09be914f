// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/simulator/CRenderer.h>

#include <cstdint>

namespace salma::simulator {

/// Velocity of the camera in its own frame.
struct TCameraMotion {
    Eigen::Vector3d linear{0, 0, 0};   //!< [m/s]
    Eigen::Vector3d angular{0, 0, 0};  //!< [rad/s]
};

/// What a real lens and sensor make of an ideal picture: motion blur, softness, vignetting,
/// exposure that varies from picture to picture, noise, 8 bits.
class CImageSensor {
 public:
    CImageSensor(const TCameraOptions& options, const CCameraModel& camera, std::uint32_t seed);

    /// \param index Number of the picture, which selects its noise. \return 8-bit BGR.
    cv::Mat develop(const TRendering& ideal,
                    const TCameraMotion& motion,
                    std::uint64_t index) const;

 private:
    cv::Mat_<cv::Vec3f> smeared(const TRendering& ideal, const TCameraMotion& motion) const;

    TCameraOptions m_options;
    const CCameraModel& m_camera;
    std::uint32_t m_seed;
};

}  // namespace salma::simulator
