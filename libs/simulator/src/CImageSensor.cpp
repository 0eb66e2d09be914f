// SPDX-License-Identifier: BSD-3-Clause
#include <salma/simulator/CImageSensor.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "seeds.h"

namespace salma::simulator {

using Eigen::Vector2f;
using Eigen::Vector3f;

namespace {

constexpr float kSharp = 0.3f;  // shorter smears are left out [px]
constexpr int kMaxTaps = 64;

cv::Vec3f between(const cv::Mat_<cv::Vec3f>& picture, float x, float y) {
    x = std::clamp(x, 0.0f, static_cast<float>(picture.cols - 1));
    y = std::clamp(y, 0.0f, static_cast<float>(picture.rows - 1));
    const int x0 = std::min(static_cast<int>(x), picture.cols - 2);
    const int y0 = std::min(static_cast<int>(y), picture.rows - 2);
    const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
    const cv::Vec3f *upper = picture[y0] + x0, *lower = picture[y0 + 1] + x0;
    return (upper[0] * (1 - fx) + upper[1] * fx) * (1 - fy) +
           (lower[0] * (1 - fx) + lower[1] * fx) * fy;
}

}  // namespace

CImageSensor::CImageSensor(const TCameraOptions& options,
                           const CCameraModel& camera,
                           std::uint32_t seed)
    : m_options(options), m_camera(camera), m_seed(seed) {
    m_options.validate();
}

cv::Mat_<cv::Vec3f> CImageSensor::smeared(const TRendering& ideal,
                                          const TCameraMotion& motion) const {
    const Vector3f linear = motion.linear.cast<float>(), angular = motion.angular.cast<float>();
    const auto time = static_cast<float>(m_options.exposureTime);
    const auto fx = static_cast<float>(m_camera.parameters().fx());
    const auto fy = static_cast<float>(m_camera.parameters().fy());
    cv::Mat_<cv::Vec3f> result = ideal.colour.clone();
    const auto width = static_cast<std::size_t>(result.cols);
    for (int row = 0; row < result.rows; ++row)
        for (int column = 0; column < result.cols; ++column) {
            const Vector2f& at = m_camera.directions()[static_cast<std::size_t>(row) * width +
                                                       static_cast<std::size_t>(column)];
            const Vector3f r(at.x(), at.y(), 1);
            // motion of the point relative to the camera, over its depth
            const Vector3f rate = -(linear * ideal.inverseDepth(row, column) + angular.cross(r));
            const float dx = fx * (rate.x() - at.x() * rate.z()) * time;
            const float dy = fy * (rate.y() - at.y() * rate.z()) * time;
            const float length = std::hypot(dx, dy);
            if (!(length > kSharp)) continue;
            const int taps = std::min(kMaxTaps, static_cast<int>(std::ceil(length)) + 2);
            cv::Vec3f sum(0, 0, 0);
            for (int i = 0; i < taps; ++i) {
                const float part = (float(i) + 0.5f) / float(taps) - 0.5f;
                sum += between(ideal.colour, float(column) + part * dx, float(row) + part * dy);
            }
            result(row, column) = sum * (1.0f / float(taps));
        }
    return result;
}

cv::Mat CImageSensor::develop(const TRendering& ideal,
                              const TCameraMotion& motion,
                              std::uint64_t index) const {
    CRandom random(m_seed, "picture", index);
    cv::Mat_<cv::Vec3f> light = smeared(ideal, motion);
    if (m_options.blur > 0) cv::GaussianBlur(light, light, {0, 0}, m_options.blur);
    const double gain = std::exp(random.normal(m_options.exposureSigma));
    cv::Mat_<cv::Vec3f> noise(light.size(), cv::Vec3f(0, 0, 0));
    if (m_options.noise > 0)
        cv::RNG(random.bits()).fill(noise, cv::RNG::NORMAL, 0, m_options.noise);
    const float cx = float(light.cols - 1) / 2, cy = float(light.rows - 1) / 2;
    for (int row = 0; row < light.rows; ++row)
        for (int column = 0; column < light.cols; ++column) {
            const float x = float(column) - cx, y = float(row) - cy;
            const float loss = float(m_options.vignetting) * (x * x + y * y) / (cx * cx + cy * cy);
            light(row, column) =
                light(row, column) * (float(gain) * (1 - loss)) + noise(row, column);
        }
    cv::Mat picture;
    light.convertTo(picture, CV_8UC3);
    return picture;
}

}  // namespace salma::simulator
