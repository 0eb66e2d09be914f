// SPDX-License-Identifier: BSD-3-Clause
#include "CConfusion.h"

#include <algorithm>
#include <iomanip>
#include <numeric>
#include <random>
#include <vector>

namespace salma::bench {

using laser::EPlaceClass;
using laser::kPlaceClasses;

void CConfusion::add(std::uint32_t building, EPlaceClass truth, EPlaceClass answer) {
    ++m_counts[building][static_cast<std::size_t>(truth)][static_cast<std::size_t>(answer)];
}

CConfusion::TCounts CConfusion::sum() const {
    TCounts all{};
    for (const auto& [building, counts] : m_counts)
        for (std::size_t i = 0; i < kPlaceClasses; ++i)
            for (std::size_t j = 0; j < kPlaceClasses; ++j) all[i][j] += counts[i][j];
    return all;
}

double CConfusion::balanced(const TCounts& counts) {
    double share = 0, classes = 0;
    for (std::size_t i = 0; i < kPlaceClasses; ++i) {
        const auto n = std::accumulate(counts[i].begin(), counts[i].end(), std::size_t{0});
        if (n == 0) continue;
        share += static_cast<double>(counts[i][i]) / static_cast<double>(n);
        ++classes;
    }
    return share / classes;
}

std::size_t CConfusion::total() const {
    std::size_t n = 0;
    for (const auto& row : sum()) n = std::accumulate(row.begin(), row.end(), n);
    return n;
}

CConfusion::TInterval CConfusion::balancedAccuracy() const {
    constexpr std::size_t kDraws = 2000;
    std::vector<const TCounts*> buildings;
    for (const auto& entry : m_counts) buildings.push_back(&entry.second);
    std::mt19937_64 random(1);
    std::vector<double> draws;
    for (std::size_t d = 0; d < kDraws; ++d) {
        TCounts all{};
        for (std::size_t b = 0; b < buildings.size(); ++b) {
            const TCounts& one = *buildings[random() % buildings.size()];
            for (std::size_t i = 0; i < kPlaceClasses; ++i)
                for (std::size_t j = 0; j < kPlaceClasses; ++j) all[i][j] += one[i][j];
        }
        draws.push_back(balanced(all));
    }
    std::sort(draws.begin(), draws.end());
    return {balanced(sum()), draws[kDraws / 40], draws[kDraws - 1 - kDraws / 40]};
}

void CConfusion::write(std::ostream& out) const {
    const TCounts all = sum();
    out << "| is \\ said |";
    for (std::size_t j = 0; j < kPlaceClasses; ++j)
        out << ' ' << asString(static_cast<EPlaceClass>(j)) << " |";
    out << " poses | right |\n|---|";
    for (std::size_t j = 0; j < kPlaceClasses + 2; ++j) out << "---:|";
    out << '\n' << std::fixed << std::setprecision(1);
    for (std::size_t i = 0; i < kPlaceClasses; ++i) {
        const auto n = std::accumulate(all[i].begin(), all[i].end(), std::size_t{0});
        out << "| " << asString(static_cast<EPlaceClass>(i)) << " |";
        for (std::size_t j = 0; j < kPlaceClasses; ++j) {
            out << ' ';
            if (all[i][j] > 0) out << all[i][j];
            out << " |";
        }
        out << ' ' << n << " | " << 100.0 * static_cast<double>(all[i][i]) / static_cast<double>(n)
            << " % |\n";
    }
    out << std::defaultfloat;
}

}  // namespace salma::bench
