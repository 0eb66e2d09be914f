// SPDX-License-Identifier: BSD-3-Clause
#include "TScaleTables.h"

#include <algorithm>
#include <cmath>

namespace salma::saliency {
namespace {

/// Largest h with h^2 <= square.
int floorRoot(int square) { return static_cast<int>(std::sqrt(static_cast<double>(square))); }

int halfWidth(int s, int j) { return floorRoot(s * s - j * j); }

int innerSquare(int s) { return floorRoot(s * s / 2); }

int roundedUp(int n) { return (n + kLanes - 1) / kLanes * kLanes; }

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
    planDiscs();
}

double TScaleTables::log(double x) const { return logTwo == 1 ? std::log2(x) : std::log(x); }

void TScaleTables::countDiscs() {
    for (int s = 0; s <= sMax; ++s) {
        int pixels = 0;
        for (int j = -s; j <= s; ++j) pixels += 2 * halfWidth(s, j) + 1;
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

void TScaleTables::planDiscs() {
    plan.origin = kLanes / 2;
    while (plan.origin < sMax) plan.origin += kLanes;
    plan.stride = roundedUp(plan.origin + kLanes + sMax + 1);
    if (plan.stride / kLanes % 2 == 0) plan.stride += kLanes;

    const int largest = innerSquare(sMax);
    std::int32_t slot = 0;
    const auto reserve = [&](std::vector<TDiscPlan::TSum>& sums, int from, int to) {
        for (int size = from; size <= to; ++size, slot += plan.stride)
            sums.push_back({size, plan.stride, 0, slot});
    };
    const int firstRow = innerSquare(sMin) + 1;
    reserve(plan.rowPairs, firstRow, sMax);
    reserve(plan.columns, 0, largest);
    reserve(plan.squares, innerSquare(sMin), largest);
    plan.scratchSize = slot;
    /// Where column x + shift of a sum is, if x is the first centre's; it will be needed.
    const auto at = [this](TDiscPlan::TSum& sum, int shift) {
        const int column = plan.origin + shift;
        sum.first = std::min(sum.first, column);
        sum.last = std::max(sum.last, column + kLanes);
        return sum.slot + column;
    };
    for (int s = sMin; s <= sMax; ++s) {
        const int m = innerSquare(s);
        auto& square = plan.squares[static_cast<std::size_t>(m - innerSquare(sMin))];
        TDiscPlan::TDisc disc{at(square, m + 1), at(square, -m), {}};
        for (int j = m + 1; j <= s; ++j) {
            const int half = halfWidth(s, j);
            auto& pair = plan.rowPairs[static_cast<std::size_t>(j - firstRow)];
            auto& column = plan.columns[static_cast<std::size_t>(half)];
            disc.rows.push_back(
                {at(pair, half + 1), at(pair, -half), at(column, j), at(column, -j)});
        }
        plan.discs.push_back(disc);
    }
    const auto unused = [](const TDiscPlan::TSum& sum) { return sum.first >= sum.last; };
    for (auto* sums : {&plan.rowPairs, &plan.columns, &plan.squares})
        sums->erase(std::remove_if(sums->begin(), sums->end(), unused), sums->end());
}

bool TScaleTables::fitsBytes() const {
    bool fits = area[static_cast<std::size_t>(sMin)] < 256;
    for (auto s = static_cast<std::size_t>(sMin) + 1; s < area.size(); ++s)
        fits = fits && area[s] - area[s - 1] < 256;
    return fits;
}

}  // namespace salma::saliency
