// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <opencv2/core.hpp>

namespace salma::calibration {

/** A picture of 800 x 600 of two boards of 10 x 7 squares of 2 cm at a right angle, with a grey
 * wall behind: x along the fold, y up the one, z along the other. \param K Of the camera [px].
 * \param R, t World to camera. */
inline cv::Mat tsaiPicture(const Eigen::Matrix3d& K,
                           const Eigen::Matrix3d& R,
                           const Eigen::Vector3d& t) {
    constexpr int fine = 3;
    constexpr double square = 0.02, width = 0.2, length = 0.14;
    cv::Mat sum(600, 800, CV_32F, cv::Scalar(0));
    const Eigen::Matrix3d back = R.transpose() * K.inverse();
    const Eigen::Vector3d eye = -R.transpose() * t;
    const auto parity = [&](double a, double b) {
        return (static_cast<int>(a / square) + static_cast<int>(b / square)) % 2;
    };
    for (int v = 0; v < fine * sum.rows; ++v)
        for (int u = 0; u < fine * sum.cols; ++u) {
            const Eigen::Vector3d ray =
                back * Eigen::Vector3d((u + 0.5) / fine - 0.5, (v + 0.5) / fine - 0.5, 1);
            float grey = 120;
            const Eigen::Vector3d a = eye - ray * (eye.z() / ray.z());  // the board z = 0
            const Eigen::Vector3d b = eye - ray * (eye.y() / ray.y());  // the board y = 0
            if (a.x() > 0 && a.x() < width && a.y() > 0 && a.y() < length)
                grey = parity(a.x(), a.y()) == 1 ? 30.0F : 220.0F;
            else if (b.x() > 0 && b.x() < width && b.z() > 0 && b.z() < length)
                grey = parity(b.x(), b.z()) == 0 ? 30.0F : 220.0F;
            sum.at<float>(v / fine, u / fine) += grey / (fine * fine);
        }
    cv::Mat grey;
    sum.convertTo(grey, CV_8U);
    return grey;
}

/// A camera that looks at such a grid from above and from the side.
struct TTsaiCamera {
    Eigen::Matrix3d K, R;
    Eigen::Vector3d t;

    TTsaiCamera() {
        K << 900, 0, 410, 0, 890, 290, 0, 0, 1;
        const Eigen::Vector3d eye(0.22, 0.25, 0.36), aim(0.1, 0.03, 0.04);
        const Eigen::Vector3d forward = (aim - eye).normalized();
        const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitY()).normalized();
        R << right.transpose(), forward.cross(right).transpose(), forward.transpose();
        t = -R * eye;
    }
};

}  // namespace salma::calibration
