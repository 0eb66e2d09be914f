// SPDX-License-Identifier: BSD-3-Clause
#include "TScaleTables.h"

#include <algorithm>
#include <cmath>

namespace salma::saliency {
namespace {

/// Largest h with h^2 <= square.
int floorRoot(int square) { return static_cast<int>(std::sqrt(static_cast<double>(square))); }

/// Smallest h with h^2 >= square.
int ceilRoot(int square) {
    const int root = floorRoot(square);
    return root * root == square ? root : root + 1;
}

}  // namespace

TScaleTables::TScaleTables(const TScaleSaliencyOptions& options)
    : sMin(options.scaleMin),
      sMax(options.scaleMax),
      bins(options.bins),
      smooth(options.smooth),
      logTwo(options.logBase == ELogBase::two ? 1 : std::log(2)) {
    countDiscs();
    nLogN.assign(static_cast<std::size_t>(area.back()) + 1, 0);
    for (std::size_t n = 2; n < nLogN.size(); ++n) {
        const auto x = static_cast<double>(n);
        nLogN[n] = x * log(x);
    }
    boundW();
    scaleBounds();
    listRings();
}

double TScaleTables::log(double x) const { return logTwo == 1 ? std::log2(x) : std::log(x); }

void TScaleTables::countDiscs() {
    for (int s = 0; s <= sMax; ++s) {
        int pixels = 0;
        for (int j = -s; j <= s; ++j) pixels += 2 * floorRoot(s * s - j * j) + 1;
        area.push_back(pixels);
    }
}

/// sum |p(s) - p(s-1)| = 2 sum max(0, r N' - n' R) / (N N') <= 2 R / N, with R = N - N' pixels in
/// the ring, r of them in a bin.
void TScaleTables::boundW() {
    dFactor.assign(area.size(), 0);
    wFactor.assign(area.size(), 0);
    wMax.assign(area.size(), 0);
    double smoothed = 0;
    for (std::size_t s = 1; s < area.size(); ++s) {
        const double n = area[s];
        const double before = area[s - 1];
        dFactor[s] = 2 / (n * before);
        wFactor[s] = static_cast<double>(s * s) / static_cast<double>(2 * s - 1);
        wMax[s] = 2 * (n - before) / n;
    }
    const auto first = static_cast<std::size_t>(sMin);
    for (std::size_t s = first; smooth && s + 1 < area.size(); ++s) {
        smoothed = s == first ? wMax[s + 1] : (smoothed + wMax[s] + wMax[s + 1]) / 3;
        wMax[s] = smoothed;
    }
    for (std::size_t s = 0; s < area.size(); ++s) wMax[s] *= wFactor[s];
}

void TScaleTables::scaleBounds() {
    const auto perWhole = [this](int k) {  // D of a whole overlap
        return 2.0 * inRing(k) / area[static_cast<std::size_t>(sMin + k)];
    };
    double largest = 0;
    for (int k = 1; k < scales(); ++k) largest = std::max(largest, perWhole(k));
    constexpr double kTop = 62000;  // toD of the largest; whole may be 4 % less than kWhole
    bound.resize(static_cast<std::size_t>(scales()));
    for (int k = 0; k < scales(); ++k) {
        auto& b = bound[static_cast<std::size_t>(k)];
        b.log2Area = static_cast<float>(std::log2(area[static_cast<std::size_t>(sMin + k)]));
        if (k == 0) continue;
        const int before = area[static_cast<std::size_t>(sMin + k - 1)];
        const int perPixel = TBoundScale::kWhole / inRing(k);
        const int whole = perPixel * inRing(k);
        int toTop = 1;
        while (before * toTop < 32768) toTop *= 2;
        b.perPixel = static_cast<std::uint16_t>(perPixel);
        b.whole = static_cast<std::uint16_t>(whole);
        b.toTop = static_cast<std::uint16_t>(toTop);
        b.perTop = static_cast<std::uint16_t>(65536.0 * whole / (before * toTop));
        b.toD =
            static_cast<std::uint16_t>(kTop * perWhole(k) / largest * TBoundScale::kWhole / whole);
        b.dUnit = 65536 / kTop * largest / TBoundScale::kWhole;
    }
}

void TScaleTables::listRings() {
    constexpr int kLine = 8;  // words
    bitmap.reach = sMax;
    bitmap.stride = (kTileRows + 2 * sMax + kLine - 1) / kLine * kLine;
    if (bitmap.stride / kLine % 2 == 0) bitmap.stride += kLine;
    bitmap.zeros = (2 * sMax + 1) * bitmap.stride;
    bitmap.size = bitmap.zeros + bitmap.stride;
    rings.resize(static_cast<std::size_t>(scales()));
    for (int dy = -sMax; dy <= sMax; ++dy) {
        for (auto& ring : rings) ring.rowStarts.push_back(ring.offsets.size());
        for (int dx = -sMax; dx <= sMax; ++dx) {
            const int s = std::max(sMin, ceilRoot(dx * dx + dy * dy));
            if (s <= sMax)
                rings[static_cast<std::size_t>(s - sMin)].offsets.push_back(bitmap.offset(dx, dy));
        }
    }
    for (auto& ring : rings) {
        ring.rowStarts.push_back(ring.offsets.size());
        while (ring.offsets.size() % kAtOnce != 0) ring.offsets.push_back(bitmap.zeros);
    }
}

int TScaleTables::inRing(int k) const {
    const auto s = static_cast<std::size_t>(sMin + k);
    return k == 0 ? area[s] : area[s] - area[s - 1];
}

bool TScaleTables::fitsBytes() const {
    bool fits = true;
    for (int k = 0; k < scales(); ++k) fits = fits && inRing(k) < 256;
    return fits;
}

}  // namespace salma::saliency
