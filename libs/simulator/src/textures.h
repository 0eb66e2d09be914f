// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace salma::simulator {

/// A picture painted by the simulator itself, the same each time.
struct TBuiltInTexture {
    cv::Mat picture;  //!< 8-bit BGR.
    double width{0};  //!< What its width stands for on a surface that it tiles [m].
};

/// Names that paintTexture() knows: plaster, brick, wood, door, plain, metal, notice, tiles,
/// panels, marker (four black and white squares that meet at its centre), exit, extinguisher and
/// plate.
std::vector<std::string> textureNames();

bool isBuiltInTexture(const std::string& name);

/// \throw std::invalid_argument for a name that is not one of textureNames().
TBuiltInTexture paintTexture(const std::string& name);

}  // namespace salma::simulator
