// SPDX-License-Identifier: BSD-3-Clause
#include "ratioTable.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace salma::apps {
namespace {

/// Neighbouring bins that share one ratio.
struct TBlock {
    double same{0}, other{0};  //!< Effective counts.
    std::size_t bins{1};
    double ratio(double sameTotal, double otherTotal) const {
        return same / sameTotal / (other / otherTotal);
    }
};

void count(const std::vector<double>& scores,
           const std::string& kind,
           std::vector<TRatioBin>& bins,
           std::size_t TRatioBin::*counter) {
    if (scores.empty()) throw std::invalid_argument("no scores of the kind '" + kind + "'");
    for (const double score : scores) {
        if (!(score >= 0 && score <= 1))
            throw std::invalid_argument("a score is " + std::to_string(score) +
                                        ", not from 0 to 1");
        const auto bin = static_cast<std::size_t>(score * static_cast<double>(bins.size()));
        ++(bins[std::min(bin, bins.size() - 1)].*counter);
    }
}

double rounded(double value, double step) { return std::round(value / step) * step; }

/// Knots at the centres of the bins, without those in the middle of a level stretch.
void setKnots(TRatioTable& table) {
    const auto& bins = table.bins;
    std::vector<double> x{0}, y{bins.front().logRatio};
    for (const auto& bin : bins) {
        x.push_back((bin.from + bin.to) / 2);
        y.push_back(bin.logRatio);
    }
    x.push_back(1);
    y.push_back(bins.back().logRatio);
    for (std::size_t i = 0; i < x.size(); ++i) {
        const bool inside = i > 0 && i + 1 < x.size();
        const double value = rounded(y[i], 0.01);
        if (inside && value == rounded(y[i - 1], 0.01) && value == rounded(y[i + 1], 0.01))
            continue;
        table.scoreKnots.push_back(rounded(x[i], 0.0001));
        table.logLrKnots.push_back(value);
    }
}

}  // namespace

TRatioTable learnTable(const std::vector<double>& same,
                       const std::vector<double>& other,
                       const TIndependent& independent,
                       const TCalibrationOptions& options) {
    TRatioTable table;
    const auto n = static_cast<std::size_t>(options.bins);
    table.bins.resize(n);
    for (std::size_t k = 0; k < n; ++k) {
        table.bins[k].from = static_cast<double>(k) / static_cast<double>(n);
        table.bins[k].to = static_cast<double>(k + 1) / static_cast<double>(n);
    }
    count(same, "same", table.bins, &TRatioBin::same);
    count(other, "other", table.bins, &TRatioBin::other);

    const auto scaleOf = [](double worth, std::size_t pairs) {
        return std::min(1.0, worth / static_cast<double>(pairs));
    };
    const double sameScale = scaleOf(independent.same, same.size());
    const double otherScale = scaleOf(independent.other, other.size());
    const double prior = options.priorCount / static_cast<double>(n);  // of a bin
    const double sameTotal = sameScale * static_cast<double>(same.size()) + options.priorCount;
    const double otherTotal = otherScale * static_cast<double>(other.size()) + options.priorCount;
    std::vector<TBlock> blocks;
    for (auto& bin : table.bins) {
        TBlock block{sameScale * static_cast<double>(bin.same) + prior,
                     otherScale * static_cast<double>(bin.other) + prior};
        bin.counted = std::log(block.ratio(sameTotal, otherTotal));
        while (!blocks.empty() &&
               blocks.back().ratio(sameTotal, otherTotal) >= block.ratio(sameTotal, otherTotal)) {
            block.same += blocks.back().same;
            block.other += blocks.back().other;
            block.bins += blocks.back().bins;
            blocks.pop_back();
        }
        blocks.push_back(block);
    }
    std::size_t k = 0;
    for (const TBlock& block : blocks) {
        const double ratio = block.ratio(sameTotal, otherTotal);
        const double spoilt = (1 - options.spoiltRate) * ratio + options.spoiltRate;
        for (std::size_t i = 0; i < block.bins; ++i) table.bins[k++].logRatio = std::log(spoilt);
    }
    setKnots(table);
    return table;
}

double readRatio(const TRatioTable& table, double score) {
    const auto& x = table.scoreKnots;
    const auto& y = table.logLrKnots;
    const auto next = std::upper_bound(x.begin() + 1, x.end() - 1, score);
    const auto i = static_cast<std::size_t>(next - x.begin());
    return y[i - 1] + (y[i] - y[i - 1]) * (score - x[i - 1]) / (x[i] - x[i - 1]);
}

}  // namespace salma::apps
