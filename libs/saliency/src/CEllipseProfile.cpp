// SPDX-License-Identifier: BSD-3-Clause
#include "CEllipseProfile.h"

#include <algorithm>
#include <cmath>

namespace salma::saliency {
namespace {

constexpr double kTie = 1e-11;  // a peak's least margin over its neighbours, as in CScaleSaliency

int ceilOf(double value) {
    const int below = static_cast<int>(value);
    return below < value ? below + 1 : below;
}

}  // namespace

double TEllipseShape::elongation() const { return std::hypot(cosine, sine); }

TEllipse TEllipseShape::ellipse(double u, double v, double s) const {
    const double log = elongation();
    const double mean = std::cosh(log) / (s * s);
    const double slope = (log > 0 ? std::sinh(log) / log : 1) / (s * s);
    return {u, v, mean - slope * cosine, -slope * sine, mean + slope * cosine};
}

CEllipseProfile::CEllipseProfile(const TScaleSaliencyOptions& options)
    : m_options(options), m_bins(options.bins) {}

void CEllipseProfile::compute(const TSampledWindow& window, const TEllipseShape& shape, int sMax) {
    const int scales = sMax - m_options.scaleMin + 1;
    m_counts.assign(static_cast<std::size_t>(scales) * static_cast<std::size_t>(m_bins), 0);
    countSamples(window, shape.ellipse(0, 0, 1), sMax);
    m_proportion.assign(static_cast<std::size_t>(m_bins), 0);
    m_entropy.clear();
    m_change.clear();
    for (int s = m_options.scaleMin; s <= sMax; ++s) computeScale(s);
    if (m_options.smooth) smooth();
    findPeaks(sMax);
}

void CEllipseProfile::countSamples(const TSampledWindow& window, const TEllipse& unit, int sMax) {
    const int centre = window.bins.rows / 2;
    const double reach = sMax * window.samplesPerPixel;
    const int halfHeight = static_cast<int>(reach * std::sqrt(unit.a));  // a c - b^2 = 1
    for (int j = -halfHeight; j <= halfHeight; ++j) {
        const double middle = -unit.b / unit.a * j;
        // A little wider, so that rounding loses nothing; the test below is exact.
        const double half = std::sqrt(std::max(reach * reach - j * j / unit.a, 0.0) / unit.a) + 0.5;
        const int last = std::min(static_cast<int>(std::floor(middle + half)), centre);
        const auto* const row = window.bins.ptr<std::uint8_t>(centre + j) + centre;
        for (int i = std::max(static_cast<int>(std::ceil(middle - half)), -centre); i <= last;
             ++i) {
            const double square = (unit.a * i + 2 * unit.b * j) * i + unit.c * j * j;
            const double radius = std::sqrt(std::max(square, 0.0)) / window.samplesPerPixel;
            const int scale = std::max(ceilOf(radius), m_options.scaleMin);
            if (scale <= sMax) ++counts(scale)[row[i]];
        }
    }
}

void CEllipseProfile::computeScale(int scale) {
    int* const n = counts(scale);
    int pixels = 0;
    for (int b = 0; b < m_bins; ++b) {
        if (scale > m_options.scaleMin) n[b] += counts(scale - 1)[b];
        pixels += n[b];
    }
    double entropy = 0;
    double change = 0;
    for (int b = 0; b < m_bins; ++b) {
        const double p = n[b] / static_cast<double>(pixels);  // there is always the centre
        if (n[b] > 0) entropy -= p * std::log(p);
        change += std::abs(p - m_proportion[static_cast<std::size_t>(b)]);
        m_proportion[static_cast<std::size_t>(b)] = p;
    }
    m_entropy.push_back(m_options.logBase == ELogBase::two ? entropy / std::log(2) : entropy);
    m_change.push_back(change);
}

void CEllipseProfile::smooth() {
    m_change[0] = m_change[1];
    for (std::size_t k = 1; k + 1 < m_change.size(); ++k)
        m_change[k] = (m_change[k - 1] + m_change[k] + m_change[k + 1]) / 3;
}

void CEllipseProfile::findPeaks(int sMax) {
    m_peaks.clear();
    for (int s = m_options.scaleMin + 1; s < sMax; ++s) {
        const auto k = static_cast<std::size_t>(s - m_options.scaleMin);
        const double h = m_entropy[k];
        if (!(h - m_entropy[k - 1] > kTie && h - m_entropy[k + 1] > kTie)) continue;
        const double w = static_cast<double>(s * s) / (2 * s - 1) * m_change[k];
        m_peaks.push_back({0, 0, static_cast<double>(s), h, w, h * w});
    }
}

}  // namespace salma::saliency
