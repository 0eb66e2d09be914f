// SPDX-License-Identifier: BSD-3-Clause
#include "reliability.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <stdexcept>

namespace salma::apps {
namespace {

constexpr int kDraws = 400;
constexpr double kLowest = -4, kHighest = 7;  // log ratios beyond fall into the bins at the ends

double probability(double logRatio) { return 1 / (1 + std::exp(-logRatio)); }

std::size_t binOf(double logRatio) {
    return static_cast<std::size_t>(std::clamp(logRatio, kLowest, kHighest) - kLowest);
}
constexpr auto kBins = static_cast<std::size_t>(kHighest - kLowest) + 1;

/// A pair with the numbers of its pictures.
struct TEntry {
    double logRatio{0};
    bool same{false};
    std::size_t a{0}, b{0};
};

struct TValues {
    double area{0}, loss{0}, error{0};
};

class CJudgement {
 public:
    explicit CJudgement(const std::vector<TJudgedPair>& pairs) {
        std::map<std::string, std::size_t> numbers;
        const auto number = [&](const std::string& texture) {
            return numbers.emplace(texture, numbers.size()).first->second;
        };
        for (const auto& pair : pairs) {
            if (!std::isfinite(pair.logRatio))
                throw std::invalid_argument("a log likelihood ratio is not finite");
            m_entries.push_back(
                {pair.logRatio, pair.same, number(pair.textureA), number(pair.textureB)});
        }
        m_textures = numbers.size();
        std::stable_sort(m_entries.begin(), m_entries.end(),
                         [](const auto& x, const auto& y) { return x.logRatio < y.logRatio; });
    }

    std::size_t textures() const { return m_textures; }

    /// \param drawn How often each texture counts. False if one kind has no weight.
    bool values(const std::vector<int>& drawn, TValues& out) const {
        double total[2] = {0, 0};
        for (const auto& e : m_entries) total[e.same ? 1 : 0] += weight(e, drawn);
        if (!(total[0] > 0 && total[1] > 0)) return false;
        out = {};
        double below = 0;  // weight of others with a smaller ratio
        double mass[kBins][2] = {}, predicted[kBins] = {};
        for (std::size_t i = 0; i < m_entries.size();) {
            double tied[2] = {0, 0};
            const double logRatio = m_entries[i].logRatio;
            for (; i < m_entries.size() && m_entries[i].logRatio == logRatio; ++i) {
                const int kind = m_entries[i].same ? 1 : 0;
                tied[kind] += weight(m_entries[i], drawn) / total[kind];
            }
            out.area += tied[1] * (below + tied[0] / 2);
            below += tied[0];
            out.loss += (tied[1] * std::log1p(std::exp(-logRatio)) +
                         tied[0] * std::log1p(std::exp(logRatio))) /
                        2;
            const std::size_t bin = binOf(logRatio);
            mass[bin][0] += tied[0] / 2;
            mass[bin][1] += tied[1] / 2;
            predicted[bin] += (tied[0] + tied[1]) / 2 * probability(logRatio);
        }
        for (std::size_t k = 0; k < kBins; ++k) out.error += std::abs(predicted[k] - mass[k][1]);
        return true;
    }

 private:
    static double weight(const TEntry& e, const std::vector<int>& drawn) {
        return e.a == e.b ? drawn[e.a] : drawn[e.a] * drawn[e.b];
    }

    std::vector<TEntry> m_entries;
    std::size_t m_textures{0};
};

TFigure figure(double value, std::vector<double> drawn) {
    if (drawn.empty()) return {value, value, value};
    std::sort(drawn.begin(), drawn.end());
    const auto at = [&](double share) {
        return drawn[static_cast<std::size_t>(share * static_cast<double>(drawn.size() - 1))];
    };
    return {value, at(0.025), at(0.975)};
}

/// Log ratio of the kinds' shares where the share of the same among all pairs of a bin is p.
double ratioAt(double p, const TReliability& r) {
    return std::log(p / (1 - p)) +
           std::log(static_cast<double>(r.other) / static_cast<double>(r.same));
}

void fillBins(const std::vector<TJudgedPair>& pairs, TReliability& r) {
    std::vector<TReliabilityBin> bins(kBins);
    std::vector<double> weights(kBins, 0);
    for (const auto& pair : pairs) {
        const std::size_t k = binOf(pair.logRatio);
        ++(pair.same ? bins[k].same : bins[k].other);
        const double weight = 1 / static_cast<double>(pair.same ? r.same : r.other);
        bins[k].predicted += weight * pair.logRatio;
        weights[k] += weight;
    }
    for (std::size_t k = 0; k < kBins; ++k) {
        if (bins[k].same + bins[k].other == 0) continue;
        bins[k].predicted /= weights[k];
        const auto share = proportion(bins[k].same, bins[k].same + bins[k].other);
        bins[k].counted = {ratioAt(share.share(), r), ratioAt(share.low, r),
                           ratioAt(share.high, r)};
        r.bins.push_back(bins[k]);
    }
}

}  // namespace

TReliability reliability(const std::vector<TJudgedPair>& pairs, std::uint32_t seed) {
    TReliability result;
    for (const auto& pair : pairs) ++(pair.same ? result.same : result.other);
    if (result.same == 0 || result.other == 0)
        throw std::invalid_argument("reliability needs pairs of the same poster and of others");
    const CJudgement judgement(pairs);
    TValues all;
    judgement.values(std::vector<int>(judgement.textures(), 1), all);
    std::vector<double> area, loss, error;
    std::mt19937 random(seed);
    for (int draw = 0; draw < kDraws; ++draw) {
        std::vector<int> drawn(judgement.textures(), 0);
        for (std::size_t i = 0; i < drawn.size(); ++i)
            ++drawn[random() % drawn.size()];  // the same on every machine, unlike distributions
        TValues values;
        if (!judgement.values(drawn, values)) continue;
        area.push_back(values.area);
        loss.push_back(values.loss);
        error.push_back(values.error);
    }
    result.areaUnderCurve = figure(all.area, area);
    result.logLoss = figure(all.loss, loss);
    result.calibrationError = figure(all.error, error);
    fillBins(pairs, result);
    return result;
}

}  // namespace salma::apps
