// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace salma::simulator {

/** A texture that can be read at any scale without aliasing.
 *
 * Texture coordinates run from 0 to 1: s to the right, t from the top row down. */
class CMipMap {
 public:
    /// \param picture 8-bit BGR, not empty. \param repeats Whether it tiles the plane; if not, the
    /// border is held. \throw std::invalid_argument
    CMipMap(const cv::Mat& picture, bool repeats);

    /** Mean colour of the parallelogram around (s, t) that is spanned by `across` and `down`, the
     * steps of (s, t) from this pixel to the next ones. Blue, green, red, 0..255. */
    cv::Vec3f sample(const cv::Vec2f& at, const cv::Vec2f& across, const cv::Vec2f& down) const;

    int columns() const { return m_levels.front().cols; }
    int rows() const { return m_levels.front().rows; }

 private:
    cv::Vec3f bilinear(std::size_t level, float s, float t) const;
    cv::Vec3f trilinear(float level, float s, float t) const;

    std::vector<cv::Mat_<cv::Vec3b>> m_levels;  //!< Each half as large as the one before.
    bool m_repeats;
};

}  // namespace salma::simulator
