// SPDX-License-Identifier: BSD-3-Clause
#include "TScaleTables.h"

#include <cmath>

namespace salma::saliency {
namespace {

/// Largest h with h^2 <= square.
int floorRoot(int square) {
    int h = 0;
    while ((h + 1) * (h + 1) <= square) ++h;
    return h;
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
}

double TScaleTables::log(double x) const { return logTwo == 1 ? std::log2(x) : std::log(x); }

void TScaleTables::countDiscs() {
    for (int s = 0; s <= sMax; ++s) {
        const int m = floorRoot(s * s / 2);
        int pixels = (2 * m + 1) * (2 * m + 1);
        std::vector<TDiscRow> rows;
        for (int j = m + 1; j <= s; ++j) {
            rows.push_back({j, floorRoot(s * s - j * j)});
            pixels += 4 * (2 * rows.back().half + 1);  // rows above and below, columns both sides
        }
        innerSquare.push_back(m);
        outerRows.push_back(rows);
        area.push_back(pixels);
    }
}

/// sum |p(s) - p(s-1)| = sum |r N' - n' R| / (N N') <= 2 R / N, with R = N - N' pixels in the ring.
void TScaleTables::boundW() {
    dFactor.assign(area.size(), 0);
    wFactor.assign(area.size(), 0);
    wMax.assign(area.size(), 0);
    for (std::size_t s = 1; s < area.size(); ++s) {
        const double n = area[s];
        const double before = area[s - 1];
        dFactor[s] = 2 / (n * before);
        wFactor[s] = static_cast<double>(s * s) / static_cast<double>(2 * s - 1);
        wMax[s] = 2 * (n - before) / n;
    }
    smoothInPlace(wMax.data() + sMin, 1);
    for (std::size_t s = 0; s < area.size(); ++s) wMax[s] *= wFactor[s];
}

void TScaleTables::smoothInPlace(double* d, int lanes) const {
    if (!smooth) return;
    for (int x = 0; x < lanes; ++x) d[x] = d[lanes + x];
    for (int k = 1; k + 1 < scales(); ++k) {
        double* row = d + static_cast<std::ptrdiff_t>(k) * lanes;
        for (int x = 0; x < lanes; ++x) row[x] = (row[x - lanes] + row[x] + row[x + lanes]) / 3;
    }
}

bool TScaleTables::fitsBytes() const {
    bool fits = area[static_cast<std::size_t>(sMin)] < 256;
    for (auto s = static_cast<std::size_t>(sMin) + 1; s < area.size(); ++s)
        fits = fits && area[s] - area[s - 1] < 256;
    return fits;
}

}  // namespace salma::saliency
