// SPDX-License-Identifier: BSD-3-Clause
#include "matchKeypoints.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace salma::appearance {
namespace {

using Words = std::array<std::int16_t, 128>;  // 16 bits: compilers turn the sum below into pmaddwd

std::vector<Words> asWords(const std::vector<observations::TKeypoint>& keypoints) {
    std::vector<Words> out(keypoints.size());
    for (std::size_t i = 0; i < keypoints.size(); ++i)
        std::copy(keypoints[i].descriptor.begin(), keypoints[i].descriptor.end(), out[i].begin());
    return out;
}

std::int32_t distance2(const Words& a, const Words& b) {
    std::int32_t sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        const auto d = static_cast<std::int16_t>(a[k] - b[k]);
        sum += d * d;
    }
    return sum;
}

/// The two nearest of one row or column.
struct TNearest {
    double first{std::numeric_limits<double>::infinity()};
    double second{std::numeric_limits<double>::infinity()};
    std::size_t index{0};

    void offer(double distance, std::size_t i) {
        if (distance < first) {
            second = first;
            first = distance;
            index = i;
        } else if (distance < second) {
            second = distance;
        }
    }
};

}  // namespace

KeypointPairs matchKeypoints(const std::vector<observations::TKeypoint>& a,
                             const std::vector<observations::TKeypoint>& b,
                             double ratio) {
    if (a.empty() || b.empty()) return {};
    const std::vector<Words> A = asWords(a);
    const std::vector<Words> B = asWords(b);
    std::vector<TNearest> ofA(a.size());
    std::vector<TNearest> ofB(b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j) {
            const double distance = distance2(A[i], B[j]);
            ofA[i].offer(distance, j);
            ofB[j].offer(distance, i);
        }
    const double ratio2 = ratio * ratio;  // distances here are squared
    const auto distinct = [&](const TNearest& n) { return n.first < ratio2 * n.second; };
    KeypointPairs pairs;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (!distinct(ofA[i])) continue;
        const std::size_t j = ofA[i].index;
        if (ofB[j].index == i && distinct(ofB[j])) pairs.emplace_back(i, j);
    }
    return pairs;
}

}  // namespace salma::appearance
