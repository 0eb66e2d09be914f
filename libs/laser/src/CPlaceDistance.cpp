// SPDX-License-Identifier: BSD-3-Clause
#include <salma/laser/CPlaceDistance.h>

#include <algorithm>
#include <cmath>

namespace salma::laser {

using observations::TPlaceLetter;
using observations::TPlaceString;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

void TPlaceDistanceOptions::visit(config::COptionVisitor& v) {
    using namespace config;
    v.number("gap", gap, moreThan(0), "cost of a letter that only one string has, in sigmas");
    v.number("short_wall_m", shortWall, moreThan(0), "shorter walls cost less, in proportion");
    v.number("free_share", freeShare, between(0, 0.4),
             "share of the shorter string that may stick out at each end");
}

CPlaceDistance::CPlaceDistance(const TPlaceDistanceOptions& options) : m_options(options) {
    m_options.validate();
}

double CPlaceDistance::gapCost(const TPlaceLetter& letter) const {
    if (letter.letter != 'W') return m_options.gap;
    return m_options.gap * std::clamp(letter.value / m_options.shortWall, 0.0, 1.0);
}

double CPlaceDistance::changeCost(const TPlaceLetter& a, const TPlaceLetter& b) {
    if (a.letter != b.letter) return kInfinity;
    const double difference = std::abs(a.value - b.value);
    if (difference == 0) return 0;
    return difference / std::sqrt(a.sigma * a.sigma + b.sigma * b.sigma);
}

double CPlaceDistance::operator()(const TPlaceString& a,
                                  const TPlaceString& b,
                                  double limit) const {
    if (b.size() > a.size()) return (*this)(b, a, limit);  // rows as short as can be
    const std::size_t n = b.size();
    const auto freeLetters = static_cast<std::size_t>(m_options.freeShare * static_cast<double>(n));
    // what is left out up to a letter, if the first ones are free
    const auto head = [&](double costOfRest, double cost, std::size_t index) {
        return index < freeLetters ? 0.0 : costOfRest + cost;
    };
    std::vector<double> row(n + 1), gapsB(n);
    double total = 0;
    for (std::size_t j = 0; j < n; ++j) {
        total += gapsB[j] = gapCost(b[j]);
        row[j + 1] = head(row[j], gapsB[j], j);
    }
    for (const TPlaceLetter& letter : a) total += gapCost(letter);
    if (!(total > 0)) return 0;
    const double most = limit * total;
    double best = kInfinity;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double gapA = gapCost(a[i]);
        double diagonal = row[0];
        double lowest = row[0] = head(row[0], gapA, i);
        for (std::size_t j = 0; j < n; ++j) {
            const double skip = std::min(row[j + 1] + gapA, row[j] + gapsB[j]);
            const double change =
                a[i].letter == b[j].letter ? diagonal + changeCost(a[i], b[j]) : kInfinity;
            diagonal = row[j + 1];
            row[j + 1] = std::min(skip, change);
            lowest = std::min(lowest, row[j + 1]);
        }
        if (lowest > most && best > most) return kInfinity;
        if (i + 1 + freeLetters >= a.size()) best = std::min(best, row[n]);
    }
    for (std::size_t j = n - freeLetters; j <= n; ++j) best = std::min(best, row[j]);
    const double distance = std::min(best / total, 1.0);
    return distance <= limit ? distance : kInfinity;
}

}  // namespace salma::laser
