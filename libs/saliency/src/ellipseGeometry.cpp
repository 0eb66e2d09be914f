// SPDX-License-Identifier: BSD-3-Clause
#include <salma/saliency/ellipseGeometry.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

namespace salma::saliency {
namespace {

/// Chords along x, at equal steps of the angle whose sine is their place between both ends.
constexpr int kChords = 256;

/// The points of an ellipse with a given y.
struct TChord {
    TChord(const TEllipse& e, double y) {
        const double dy = y - e.v;
        const double middle = e.u - e.b * dy / e.a;
        const double square = e.a - (e.a * e.c - e.b * e.b) * dy * dy;
        const double half = std::sqrt(std::max(0.0, square)) / e.a;
        left = middle - half;
        right = middle + half;
    }

    double left;
    double right;
};

}  // namespace

cv::Size2d halfBox(const TEllipse& e) {
    const double determinant = e.a * e.c - e.b * e.b;
    return {std::sqrt(e.c / determinant), std::sqrt(e.a / determinant)};
}

double intersectionArea(const TEllipse& first, const TEllipse& second) {
    const double firstHalf = halfBox(first).height;
    const double secondHalf = halfBox(second).height;
    const double top = std::max(first.v - firstHalf, second.v - secondHalf);
    const double bottom = std::min(first.v + firstHalf, second.v + secondHalf);
    if (!(top < bottom)) return 0;
    // y = middle + half sin(angle) takes out the square roots at both ends.
    const double middle = (top + bottom) / 2;
    const double half = (bottom - top) / 2;
    const double step = CV_PI / kChords;
    double sine = -std::cos(step / 2);
    double cosine = std::sin(step / 2);
    const double sineOfStep = std::sin(step);
    const double cosineOfStep = std::cos(step);
    double sum = 0;
    for (int i = 0; i < kChords; ++i) {
        const double y = middle + half * sine;
        const TChord a(first, y);
        const TChord b(second, y);
        sum += cosine * std::max(0.0, std::min(a.right, b.right) - std::max(a.left, b.left));
        const double next = sine * cosineOfStep + cosine * sineOfStep;
        cosine = cosine * cosineOfStep - sine * sineOfStep;
        sine = next;
    }
    return sum * half * step;
}

double overlapError(const TEllipse& first, const TEllipse& second) {
    const double areas = CV_PI * (std::pow(first.radius(), 2) + std::pow(second.radius(), 2));
    const double shared = intersectionArea(first, second);
    return std::clamp(1 - shared / (areas - shared), 0.0, 1.0);
}

bool isInvertible(const cv::Matx33d& homography) {
    for (const double value : homography.val)
        if (!std::isfinite(value)) return false;
    cv::Matx31d singularValues;
    cv::SVD::compute(homography, singularValues, cv::SVD::NO_UV);
    return singularValues(2) > 1e-12 * singularValues(0);
}

std::optional<TEllipse> mapped(const cv::Matx33d& H_b_a, const TEllipse& e) {
    const cv::Vec3d p = H_b_a * cv::Vec3d(e.u, e.v, 1);
    TEllipse image{p[0] / p[2], p[1] / p[2], 0, 0, 0};
    // Derivative of the image point by (x, y).
    const cv::Matx22d J(
        (H_b_a(0, 0) - image.u * H_b_a(2, 0)) / p[2], (H_b_a(0, 1) - image.u * H_b_a(2, 1)) / p[2],
        (H_b_a(1, 0) - image.v * H_b_a(2, 0)) / p[2], (H_b_a(1, 1) - image.v * H_b_a(2, 1)) / p[2]);
    const double determinant = J(0, 0) * J(1, 1) - J(0, 1) * J(1, 0);
    const cv::Matx22d inverse(J(1, 1) / determinant, -J(0, 1) / determinant, -J(1, 0) / determinant,
                              J(0, 0) / determinant);
    const cv::Matx22d shape = inverse.t() * cv::Matx22d(e.a, e.b, e.b, e.c) * inverse;
    image.a = shape(0, 0);
    image.b = shape(0, 1);
    image.c = shape(1, 1);
    const bool isEllipse = image.a > 0 && image.a * image.c - image.b * image.b > 0;
    if (!isEllipse || !std::isfinite(image.u + image.v + image.a + image.b + image.c)) return {};
    return image;
}

}  // namespace salma::saliency
