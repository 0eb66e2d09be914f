// SPDX-License-Identifier: BSD-3-Clause
#include <salma/saliency/CAffineSaliency.h>
#include <salma/saliency/ellipseGeometry.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "CEllipseProfile.h"
#include "binTable.h"

namespace salma::saliency {

using observations::TSalientRegion;

namespace {

constexpr double kFirstStep = 0.8, kLastStep = 0.05;  // of the shape
constexpr double kNearPeak = M_SQRT2;  // an entropy peak so many times larger or smaller is near
constexpr double kScaleLimit = 2;      // so many times larger or smaller than the disc
constexpr double kRadius = 12;         // discs of fewer samples' radius are sampled finer
constexpr int kMostSamples = 4;        // along a pixel

/// Grey level between four pixels.
double greyAt(const cv::Mat& grey, double x, double y) {
    const int left = std::clamp(static_cast<int>(x), 0, grey.cols - 1);
    const int top = std::clamp(static_cast<int>(y), 0, grey.rows - 1);
    const int right = std::min(left + 1, grey.cols - 1);
    const double fx = std::clamp(x - left, 0.0, 1.0);
    const double fy = std::clamp(y - top, 0.0, 1.0);
    const auto* const upper = grey.ptr<std::uint8_t>(top);
    const auto* const lower = grey.ptr<std::uint8_t>(std::min(top + 1, grey.rows - 1));
    return (1 - fy) * ((1 - fx) * upper[left] + fx * upper[right]) +
           fy * ((1 - fx) * lower[left] + fx * lower[right]);
}

/// The search for one disc's ellipse.
class CEllipseSearch {
 public:
    CEllipseSearch(const TAffineOptions& options, const TScaleSaliencyOptions& saliency)
        : m_options(options), m_saliency(saliency), m_profile(saliency) {}

    /// What an ellipse's shape achieves.
    struct TState {
        TEllipseShape shape;
        TSalientRegion peak;  // s, H, W, Y
        double score{0};
    };

    /// Nothing if no ellipse near has an entropy peak.
    std::optional<TState> run(const cv::Mat& grey,
                              const cv::Mat& table,
                              const TSalientRegion& disc) {
        m_disc = disc;
        m_picture = grey.size();
        m_steps = 0;
        m_top = static_cast<int>(std::min<double>(m_saliency.scaleMax, kScaleLimit * disc.s + 1));
        sample(grey, table);
        auto best = evaluate({}, disc.s);
        for (double step = kFirstStep; step >= kLastStep && !exhausted(); step /= 2)
            while (!exhausted() && improve(best, step)) ++m_steps;
        return best;
    }

    bool exhausted() const { return m_steps >= m_options.maxSteps; }

 private:
    void sample(const cv::Mat& grey, const cv::Mat& table) {
        const double finer = std::ceil(kRadius / m_disc.s);
        m_window.samplesPerPixel = static_cast<int>(std::clamp<double>(finer, 1, kMostSamples));
        const int n = m_window.samplesPerPixel;
        const int reach = static_cast<int>(m_top * n * std::sqrt(m_options.maxRatio)) + 1;
        m_window.bins.create(2 * reach + 1, 2 * reach + 1, CV_8UC1);
        for (int j = -reach; j <= reach; ++j) {
            auto* const row = m_window.bins.ptr<std::uint8_t>(reach + j) + reach;
            const double y = m_disc.y + static_cast<double>(j) / n;
            for (int i = -reach; i <= reach; ++i) {
                const double value = greyAt(grey, m_disc.x + static_cast<double>(i) / n, y);
                row[i] = table.at<std::uint8_t>(static_cast<int>(std::lround(value)));
            }
        }
    }

    /// Largest scale whose ellipse lies in the picture.
    int room(const TEllipseShape& shape) const {
        const cv::Size2d half = halfBox(shape.ellipse(0, 0, 1));
        const double across = std::min(m_disc.x, m_picture.width - 1 - m_disc.x);
        const double down = std::min(m_disc.y, m_picture.height - 1 - m_disc.y);
        return static_cast<int>(std::min(across / half.width, down / half.height));
    }

    /// The entropy peak of largest Y near `scale`, for ellipses of this shape.
    std::optional<TState> evaluate(const TEllipseShape& shape, double scale) {
        if (!(shape.elongation() <= std::log(m_options.maxRatio))) return std::nullopt;
        const double near = std::min<double>(m_top, scale * kNearPeak + 1);
        const int sMax = std::min(static_cast<int>(near), room(shape));
        if (sMax < m_saliency.scaleMin + 2) return std::nullopt;
        m_profile.compute(m_window, shape, sMax);
        const double least = std::max(scale / kNearPeak, m_disc.s / kScaleLimit);
        std::optional<TState> best;
        for (const auto& peak : m_profile.peaks())
            if (peak.s >= least && (!best || peak.Y > best->peak.Y)) best = TState{shape, peak, 0};
        if (best) best->score = best->peak.Y - m_options.elongationCost * shape.elongation();
        return best;
    }

    /// Moves to the best of the eight shapes around the present one, if it is better.
    bool improve(std::optional<TState>& best, double step) {
        constexpr double kDiagonal = M_SQRT1_2;
        constexpr double kDirections[][2] = {
            {1, 0},  {kDiagonal, kDiagonal},   {0, 1},  {-kDiagonal, kDiagonal},
            {-1, 0}, {-kDiagonal, -kDiagonal}, {0, -1}, {kDiagonal, -kDiagonal}};
        const TEllipseShape from = best ? best->shape : TEllipseShape{};
        const double scale = best ? best->peak.s : m_disc.s;
        bool better = false;
        for (const auto& [cosine, sine] : kDirections) {
            const auto next =
                evaluate({from.cosine + step * cosine, from.sine + step * sine}, scale);
            if (!next || (best && !(next->score > best->score))) continue;
            best = next;
            better = true;
        }
        return better;
    }

    TAffineOptions m_options;
    TScaleSaliencyOptions m_saliency;
    CEllipseProfile m_profile;
    TSampledWindow m_window;
    TSalientRegion m_disc;
    cv::Size m_picture;
    int m_top{0};
    int m_steps{0};
};

void check(const TSalientRegion& disc, const cv::Size& picture, std::size_t index) {
    const bool inside =
        disc.x >= 0 && disc.x <= picture.width - 1 && disc.y >= 0 && disc.y <= picture.height - 1;
    if (inside && disc.s > 0 && std::isfinite(disc.s)) return;
    throw std::invalid_argument(
        "affine saliency: disc " + std::to_string(index) + " (x " + std::to_string(disc.x) +
        ", y " + std::to_string(disc.y) + ", scale " + std::to_string(disc.s) +
        ") has no positive scale, or its centre is not in the picture of " +
        std::to_string(picture.width) + "x" + std::to_string(picture.height));
}

}  // namespace

void TAffineOptions::visit(config::COptionVisitor& v) {
    v.flag("use", use, "adapt salient discs to ellipses");
    v.number("max_ratio", maxRatio, config::between(1, 10), "largest ratio of an ellipse's axes");
    v.number("elongation_cost", elongationCost, config::atLeast(0),
             "saliency to gain for each unit of the logarithm of the axis ratio");
    v.integer("max_steps", maxSteps, config::between(1, 1000),
              "changes of shape after which the search for one region ends");
}

CAffineSaliency::CAffineSaliency(const TAffineOptions& options,
                                 const TScaleSaliencyOptions& saliency)
    : m_options(options), m_saliency(saliency) {
    m_options.validate();
    m_saliency.validate();
}

TAffineRegions CAffineSaliency::adapt(const cv::Mat& grey,
                                      const std::vector<TSalientRegion>& discs) const {
    if (grey.type() != CV_8UC1)
        throw std::invalid_argument("affine saliency needs a grey picture of 8 bits (CV_8UC1)");
    for (std::size_t i = 0; i < discs.size(); ++i) check(discs[i], grey.size(), i);
    TAffineRegions result;
    if (discs.empty()) return result;
    const cv::Mat table = binTable(grey, m_saliency);
    CEllipseSearch search(m_options, m_saliency);
    for (const auto& disc : discs) {
        const auto found = search.run(grey, table, disc);
        if (found) {
            const auto& peak = found->peak;
            result.regions.push_back(
                {found->shape.ellipse(disc.x, disc.y, peak.s), peak.H, peak.W, peak.Y});
            if (search.exhausted()) ++result.notConverged;
        } else {
            result.regions.push_back({ellipseOf(disc), disc.H, disc.W, disc.Y});
            ++result.withoutPeak;
        }
    }
    return result;
}

TSalientRegion asDisc(const TAffineRegion& region) {
    const TEllipse& e = region.ellipse;
    return {e.u, e.v, e.radius(), region.H, region.W, region.Y};
}

}  // namespace salma::saliency
