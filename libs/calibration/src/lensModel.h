// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/TCamera.h>

#include <array>

namespace salma::calibration {

/// A pinhole with Brown's distortion: fx, fy, cx, cy [px], k1, k2, p1, p2, k3.
template <typename T>
using TLens = std::array<T, 9>;

template <typename T>
TLens<T> lensOf(const mrpt::img::TCamera& camera) {
    const bool none = camera.distortion == mrpt::img::DistortionModel::none;
    TLens<T> lens{T(camera.fx()), T(camera.fy()), T(camera.cx()), T(camera.cy())};
    for (std::size_t i = 0; i < 5; ++i) lens[4 + i] = T(none ? 0 : camera.dist[i]);
    return lens;
}

/** Pixel of a point in front of the camera. \param X [m] In the camera's frame, X[2] > 0.
 * Templated for automatic derivatives. Source: D. Brown, "Close-range camera calibration",
 * Photogrammetric Engineering 37(8), 1971, in OpenCV's order. */
template <typename T>
void project(const TLens<T>& lens, const T* X, T* uv) {
    const T x = X[0] / X[2], y = X[1] / X[2];
    const T rr = x * x + y * y;
    const T radial = T(1) + rr * (lens[4] + rr * (lens[5] + rr * lens[8]));
    const T dx = T(2) * lens[6] * x * y + lens[7] * (rr + T(2) * x * x);
    const T dy = lens[6] * (rr + T(2) * y * y) + T(2) * lens[7] * x * y;
    uv[0] = lens[0] * (x * radial + dx) + lens[2];
    uv[1] = lens[1] * (y * radial + dy) + lens[3];
}

}  // namespace salma::calibration
