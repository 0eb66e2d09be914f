// SPDX-License-Identifier: BSD-3-Clause
#include <salma/appearance/CTexture.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "sampleWall.h"

namespace salma::appearance {
namespace {

constexpr int kReach = 3;  // pixels that the larger circle and its interpolation touch
constexpr int kContrasts = 5;
constexpr double kContrastLimits[kContrasts - 1] = {0.01, 0.025, 0.06, 0.15};  // deviation / mean

/// A point of the circle around a pixel, read between four pixels.
struct TTap {
    int dx, dy;
    float weights[4];  // of (dx, dy), (dx+1, dy), (dx, dy+1), (dx+1, dy+1)
};

std::vector<TTap> circle(int points, double radius) {
    std::vector<TTap> taps;
    for (int i = 0; i < points; ++i) {
        // rounded, so that a quarter turn maps the taps onto each other exactly
        const auto exact = [](double x) { return std::round(x * 1e9) / 1e9; };
        const double x = exact(radius * std::cos(2 * M_PI * i / points));
        const double y = exact(-radius * std::sin(2 * M_PI * i / points));
        TTap tap{static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)), {}};
        const auto fx = static_cast<float>(x - tap.dx), fy = static_cast<float>(y - tap.dy);
        tap.weights[0] = (1 - fx) * (1 - fy);
        tap.weights[1] = fx * (1 - fy);
        tap.weights[2] = (1 - fx) * fy;
        tap.weights[3] = fx * fy;
        taps.push_back(tap);
    }
    return taps;
}

float read(const cv::Mat& wall, int row, int col, const TTap& tap) {
    const auto* upper = wall.ptr<float>(row + tap.dy) + col + tap.dx;
    const auto* lower = wall.ptr<float>(row + tap.dy + 1) + col + tap.dx;
    return tap.weights[0] * upper[0] + tap.weights[1] * upper[1] + tap.weights[2] * lower[0] +
           tap.weights[3] * lower[1];
}

/// Number of ones if the circle changes at most twice between 0 and 1, else points + 1.
int riu2(const std::vector<char>& bits) {
    int ones = 0, changes = 0;
    for (std::size_t i = 0; i < bits.size(); ++i) {
        ones += bits[i];
        changes += bits[i] != bits[(i + 1) % bits.size()] ? 1 : 0;
    }
    return changes <= 2 ? ones : static_cast<int>(bits.size()) + 1;
}

int contrastClass(double deviation, double mean) {
    const double contrast = deviation / std::max(mean, 1.0);
    return static_cast<int>(
        std::upper_bound(std::begin(kContrastLimits), std::end(kContrastLimits), contrast) -
        std::begin(kContrastLimits));
}

/// Adds the joint histogram of one circle, of mass `mass`, at `out`.
void addCircle(
    const cv::Mat& wall, const cv::Mat& mask, int points, double radius, double mass, double* out) {
    constexpr float kTie = 1e-3F;  // rounding must not decide a bit [grey levels]
    const auto taps = circle(points, radius);
    std::vector<char> bits(taps.size());
    for (int row = kReach; row < wall.rows - kReach; ++row)
        for (int col = kReach; col < wall.cols - kReach; ++col) {
            if (mask.at<std::uint8_t>(row, col) == 0) continue;
            const float centre = wall.at<float>(row, col);
            double sum = 0, squares = 0;
            for (std::size_t i = 0; i < taps.size(); ++i) {
                const float g = read(wall, row, col, taps[i]);
                bits[i] = static_cast<char>(g >= centre - kTie);
                sum += g - centre;
                squares += static_cast<double>(g - centre) * (g - centre);
            }
            const double mean = sum / points;
            const double deviation = std::sqrt(std::max(0.0, squares / points - mean * mean));
            out[riu2(bits) * kContrasts + contrastClass(deviation, centre + mean)] += mass;
        }
}

}  // namespace

void TTextureOptions::visit(config::COptionVisitor& v) {
    using namespace config;
    v.number("px_per_m", pixelsPerMetre, between(10, 400),
             "resolution for all walls; finer views are averaged");
    v.number("margin_m", margin, between(0.05, 2),
             "how far around the entity the wall is looked at");
    v.number("gap_m", gap, between(0, 1), "so far from the entity's border it begins");
    v.integer("min_pixels", minPixels, atLeast(1), "fewer pixels of wall say nothing");
}

CTexture::CTexture(const TTextureOptions& options) : m_options(options) { m_options.validate(); }

std::vector<float> CTexture::describe(const cv::Mat& wall, const cv::Mat& mask) const {
    if (wall.empty()) return {};
    if (wall.type() != CV_8UC1 && wall.type() != CV_32FC1)
        throw std::invalid_argument("a texture needs a grey picture");
    if (!mask.empty() && (mask.type() != CV_8UC1 || mask.size() != wall.size()))
        throw std::invalid_argument("the mask of a texture has another size or type");
    cv::Mat grey, usable(wall.size(), CV_8UC1, cv::Scalar(255));
    wall.convertTo(grey, CV_32F);
    if (!mask.empty())  // the whole circle must be wall
        cv::erode(mask, usable, cv::Mat::ones(2 * kReach + 1, 2 * kReach + 1, CV_8U));
    if (wall.rows <= 2 * kReach || wall.cols <= 2 * kReach) return {};
    const int pixels =
        cv::countNonZero(usable({kReach, kReach, wall.cols - 2 * kReach, wall.rows - 2 * kReach}));
    if (pixels < m_options.minPixels) return {};
    std::vector<double> out(kBins, 0.0);
    const double mass = 0.5 / pixels;
    addCircle(grey, usable, 8, 1, mass, out.data());
    addCircle(grey, usable, 16, 2, mass, out.data() + 10 * kContrasts);
    return {out.begin(), out.end()};
}

std::vector<float> CTexture::describe(const cv::Mat& grey,
                                      const CWallView& view,
                                      const TWallRectangle& r) const {
    const double width = r.u1 - r.u0, height = r.v1 - r.v0;
    if (grey.empty() || !(width > 0) || !(height > 0) || !(std::max(width, height) < 20) ||
        !view.toPixel((r.u0 + r.u1) / 2, (r.v0 + r.v1) / 2))
        return {};
    const double beyond = m_options.margin, ppm = m_options.pixelsPerMetre;
    const TWallRectangle wide{r.u0 - beyond, r.v0 - beyond, r.u1 + beyond, r.v1 + beyond};
    const cv::Size size(static_cast<int>(std::lround((width + 2 * beyond) * ppm)),
                        static_cast<int>(std::lround((height + 2 * beyond) * ppm)));
    cv::Mat fine;
    grey.convertTo(fine, CV_32F);  // averages of calm walls differ by less than a grey level
    TWallSample wall = sampleWall(fine, view, wide, size);
    const int from = static_cast<int>(std::floor((beyond - m_options.gap) * ppm));
    if (from > 0)
        cv::rectangle(wall.valid, cv::Point(from, from),
                      cv::Point(size.width - 1 - from, size.height - 1 - from), cv::Scalar(0),
                      cv::FILLED);
    return describe(wall.grey, wall.valid);
}

std::optional<double> textureDistance(const std::vector<float>& a, const std::vector<float>& b) {
    if (a.empty() || a.size() != b.size()) return std::nullopt;
    double common = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        common += std::sqrt(std::max(0.0, static_cast<double>(a[i]) * b[i]));
    if (!std::isfinite(common)) return std::nullopt;
    return std::sqrt(std::clamp(1 - common, 0.0, 1.0));
}

}  // namespace salma::appearance
