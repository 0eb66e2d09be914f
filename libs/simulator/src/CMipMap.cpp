// SPDX-License-Identifier: BSD-3-Clause
#include <salma/simulator/CMipMap.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace salma::simulator {
namespace {

constexpr int kMaxTaps = 16;  // along the long axis of the footprint

int wrapped(int i, int size, bool repeats) {
    if (!repeats) return std::clamp(i, 0, size - 1);
    const int rest = i % size;
    return rest < 0 ? rest + size : rest;
}

}  // namespace

CMipMap::CMipMap(const cv::Mat& picture, bool repeats) : m_repeats(repeats) {
    if (picture.empty() || picture.type() != CV_8UC3)
        throw std::invalid_argument("a texture must be a picture of 8-bit colours");
    m_levels.emplace_back(picture.clone());
    while (m_levels.back().cols > 1 || m_levels.back().rows > 1) {
        const cv::Mat& last = m_levels.back();
        cv::Mat half;
        cv::resize(last, half, {std::max(1, last.cols / 2), std::max(1, last.rows / 2)}, 0, 0,
                   cv::INTER_AREA);
        m_levels.emplace_back(half);
    }
}

cv::Vec3f CMipMap::bilinear(std::size_t level, float s, float t) const {
    const auto& picture = m_levels[level];
    const float x = s * static_cast<float>(picture.cols) - 0.5f;
    const float y = t * static_cast<float>(picture.rows) - 0.5f;
    const float left = std::floor(x), top = std::floor(y);
    const float fx = x - left, fy = y - top;
    const int x0 = wrapped(static_cast<int>(left), picture.cols, m_repeats);
    const int x1 = wrapped(static_cast<int>(left) + 1, picture.cols, m_repeats);
    const cv::Vec3b* upper =
        picture.ptr<cv::Vec3b>(wrapped(static_cast<int>(top), picture.rows, m_repeats));
    const cv::Vec3b* lower =
        picture.ptr<cv::Vec3b>(wrapped(static_cast<int>(top) + 1, picture.rows, m_repeats));
    const float w00 = (1 - fx) * (1 - fy), w01 = fx * (1 - fy), w10 = (1 - fx) * fy, w11 = fx * fy;
    cv::Vec3f colour;
    for (int c = 0; c < 3; ++c)
        colour[c] = w00 * float(upper[x0][c]) + w01 * float(upper[x1][c]) +
                    w10 * float(lower[x0][c]) + w11 * float(lower[x1][c]);
    return colour;
}

cv::Vec3f CMipMap::trilinear(float level, float s, float t) const {
    const float top = static_cast<float>(m_levels.size() - 1);
    const float clamped = std::clamp(level, 0.0f, top);
    const auto fine = static_cast<std::size_t>(clamped);
    const float part = clamped - static_cast<float>(fine);
    if (part == 0 || fine + 1 == m_levels.size()) return bilinear(fine, s, t);
    return bilinear(fine, s, t) * (1 - part) + bilinear(fine + 1, s, t) * part;
}

cv::Vec3f CMipMap::sample(const cv::Vec2f& at,
                          const cv::Vec2f& across,
                          const cv::Vec2f& down) const {
    const cv::Vec2f size(static_cast<float>(columns()), static_cast<float>(rows()));
    const cv::Vec2f a = across.mul(size), b = down.mul(size);  // in texels
    const bool acrossIsLonger = a.dot(a) >= b.dot(b);
    const cv::Vec2f& axis = acrossIsLonger ? across : down;
    const float longSide = std::max(1e-6f, std::sqrt(std::max(a.dot(a), b.dot(b))));
    const float shortSide = std::max(1.0f, std::abs(a[0] * b[1] - a[1] * b[0]) / longSide);
    const int taps = std::clamp(static_cast<int>(std::ceil(longSide / shortSide)), 1, kMaxTaps);
    const float texels = std::max(shortSide, longSide / static_cast<float>(taps));
    const float level = std::log2(std::max(1.0f, texels));
    cv::Vec3f sum(0, 0, 0);
    for (int i = 0; i < taps; ++i) {
        const float along = (static_cast<float>(i) + 0.5f) / static_cast<float>(taps) - 0.5f;
        const cv::Vec2f p = at + axis * along;
        sum += trilinear(level, p[0], p[1]);
    }
    return sum * (1.0f / static_cast<float>(taps));
}

}  // namespace salma::simulator
