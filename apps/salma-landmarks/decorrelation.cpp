// SPDX-License-Identifier: BSD-3-Clause
#include "decorrelation.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace salma::apps {
namespace {

/// Number of the track that each sighting belongs to.
std::vector<std::size_t> tracksOf(const TLabelledRun& run, double gap, std::size_t& tracks) {
    std::map<int, std::pair<double, std::size_t>> last;  // by poster: time, track
    std::vector<std::size_t> result;
    for (const auto& seen : run.seen) {
        const auto found = last.find(seen.poster);
        const bool goesOn = found != last.end() && seen.time - found->second.first <= gap;
        const std::size_t track = goesOn ? found->second.second : tracks++;
        last[seen.poster] = {seen.time, track};
        result.push_back(track);
    }
    return result;
}

/// A view of a track, and what it scored against one view of the map.
struct TScored {
    std::size_t track{0};
    double angle{0};  //!< [rad]
    double logRatio{0};
};

class CCorrelation {
 public:
    CCorrelation(const TCalibrationOptions& options, TDecorrelation& result)
        : m_options(options), m_result(result) {
        const auto n = static_cast<std::size_t>(std::ceil(M_PI / options.angleStep));
        for (std::size_t k = 0; k < n; ++k) {
            TAngleBin bin;
            bin.from = static_cast<double>(k) * options.angleStep;
            bin.to = static_cast<double>(k + 1) * options.angleStep;
            m_result.bins.push_back(bin);
        }
        m_sums.resize(n);
    }

    /// All views of a poster against one view of the map.
    void add(const std::vector<TScored>& views) {
        for (std::size_t i = 0; i < views.size(); ++i)
            for (std::size_t j = i + 1; j < views.size(); ++j) {
                if (views[i].track != views[j].track) continue;
                const double change =
                    std::abs(mrpt::math::wrapToPi(views[i].angle - views[j].angle));
                const auto k = std::min(static_cast<std::size_t>(change / m_options.angleStep),
                                        m_sums.size() - 1);
                const double x = views[i].logRatio, y = views[j].logRatio;
                m_sums[k].value += (x + y) / 2;
                m_sums[k].square += (x * x + y * y) / 2;
                m_sums[k].product += x * y;
                ++m_result.bins[k].pairs;
            }
    }

    void finish() {
        for (std::size_t k = 0; k < m_sums.size(); ++k) m_result.bins[k].correlation = of(k);
        fit();
        for (const TAngleBin& bin : m_result.bins)
            if (bin.fitted <= m_options.independent) {
                m_result.angle = bin.from;
                return;
            }
    }

 private:
    struct TSums {
        double value{0}, square{0}, product{0};
    };

    /// Pearson's coefficient of a bin, both orders of each pair counted.
    double of(std::size_t k) const {
        const std::size_t pairs = m_result.bins[k].pairs;
        if (pairs < static_cast<std::size_t>(m_options.minPairs))
            return std::numeric_limits<double>::quiet_NaN();
        const auto n = static_cast<double>(pairs);
        const double mean = m_sums[k].value / n;
        const double variance = m_sums[k].square / n - mean * mean;
        if (!(variance > 0)) return std::numeric_limits<double>::quiet_NaN();
        return (m_sums[k].product / n - mean * mean) / variance;
    }

    /// The nearest sequence that does not rise, each bin weighing as its pairs.
    void fit() {
        struct TBlock {
            double sum{0}, weight{0};
            std::size_t bins{0};
        };
        std::vector<TBlock> blocks;
        for (const TAngleBin& bin : m_result.bins) {
            if (std::isnan(bin.correlation)) continue;
            const auto weight = static_cast<double>(bin.pairs);
            TBlock block{bin.correlation * weight, weight, 1};
            while (!blocks.empty() &&
                   blocks.back().sum / blocks.back().weight <= block.sum / block.weight) {
                block.sum += blocks.back().sum;
                block.weight += blocks.back().weight;
                block.bins += blocks.back().bins;
                blocks.pop_back();
            }
            blocks.push_back(block);
        }
        auto block = blocks.begin();
        std::size_t used = 0;
        for (TAngleBin& bin : m_result.bins) {
            if (std::isnan(bin.correlation)) continue;
            bin.fitted = block->sum / block->weight;
            if (++used < block->bins) continue;
            ++block;
            used = 0;
        }
    }

    const TCalibrationOptions& m_options;
    TDecorrelation& m_result;
    std::vector<TSums> m_sums;
};

}  // namespace

TDecorrelation decorrelation(const std::vector<TLabelledRun>& runs,
                             const std::vector<std::vector<TLabelledPair>>& pairs,
                             const std::function<double(const TLabelledPair&)>& logRatio,
                             const TCalibrationOptions& options) {
    TDecorrelation result;
    CCorrelation correlation(options, result);
    for (std::size_t r = 0; r < runs.size(); ++r) {
        const auto tracks = tracksOf(runs[r], options.trackGap, result.tracks);
        std::map<std::size_t, std::vector<TScored>> byMapView;
        for (const auto& pair : pairs[r]) {
            if (pair.kind != EPair::same || tracks[pair.a] == tracks[pair.b]) continue;
            const double value = logRatio(pair);
            byMapView[pair.a].push_back({tracks[pair.b], runs[r].seen[pair.b].angle, value});
            byMapView[pair.b].push_back({tracks[pair.a], runs[r].seen[pair.a].angle, value});
        }
        for (const auto& [view, others] : byMapView) correlation.add(others);
    }
    correlation.finish();
    return result;
}

}  // namespace salma::apps
