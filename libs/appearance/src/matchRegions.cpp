// SPDX-License-Identifier: BSD-3-Clause
#include "matchRegions.h"

#include <mrpt/math/distributions.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "lengthErrors.h"
#include "regionLooks.h"

namespace salma::appearance {
namespace {

using Indices = std::vector<std::size_t>;

constexpr int kRefinements = 3;
constexpr int kFewest = 3;  // fewer strong regions in each patch say nothing

bool usable(const observations::TPatch& patch, const TLengthErrors& stretch) {
    const auto finite = [](const observations::TSalientRegion& r) {
        return std::isfinite(r.x + r.y + r.s) && r.s > 0;
    };
    return !patch.regions.empty() && stretch.u >= 0 && stretch.v >= 0 &&
           std::isfinite(stretch.u + stretch.v) &&
           std::all_of(patch.regions.begin(), patch.regions.end(), finite);
}

/// A region of a and one of b that could be the same.
struct TCandidate {
    std::size_t a, b;
    double dx, dy;        // from a to b [m]
    double varX, varY;    // of these [m^2]
    double sizeDistance;  // squared Mahalanobis distance of log s
    bool alike;
};

class CRegionPairing {
 public:
    CRegionPairing(const TRegionMatchOptions& options,
                   const observations::TPatch& a,
                   const observations::TPatch& b,
                   const TLengthErrors& stretch)
        : m_options(options),
          m_a(a),
          m_b(b),
          m_gate(mrpt::math::chi2inv(options.gateQuantile, 3)),
          m_stretch(stretch) {
        collect();
    }

    /// One to one, nearest first, under a shift.
    Indices pairs(double tx, double ty, bool alikeOnly) const {
        std::vector<std::pair<double, std::size_t>> inGate;
        for (std::size_t k = 0; k < m_candidates.size(); ++k) {
            const auto& c = m_candidates[k];
            if (alikeOnly && !c.alike) continue;
            const double x = c.dx - tx, y = c.dy - ty;
            const double d2 = x * x / c.varX + y * y / c.varY + c.sizeDistance;
            if (d2 <= m_gate) inGate.emplace_back(d2, k);
        }
        std::sort(inGate.begin(), inGate.end());
        std::vector<char> takenA(m_a.regions.size()), takenB(m_b.regions.size());
        Indices chosen;
        for (const auto& [d2, k] : inGate) {
            const auto& c = m_candidates[k];
            if (takenA[c.a] || takenB[c.b]) continue;
            takenA[c.a] = takenB[c.b] = 1;
            chosen.push_back(k);
        }
        return chosen;
    }

    /// The shift of one pair that most pairs share, then their weighted mean.
    Indices onCommonShift(bool alikeOnly, double& tx, double& ty) const {
        Indices best;
        for (const auto& c : m_candidates) {
            if ((alikeOnly && !c.alike) || std::abs(c.dx) > m_options.maxShift ||
                std::abs(c.dy) > m_options.maxShift)
                continue;
            auto found = pairs(c.dx, c.dy, alikeOnly);
            if (found.size() <= best.size()) continue;
            best = std::move(found);
            tx = c.dx;
            ty = c.dy;
        }
        for (int i = 0; i < kRefinements && !best.empty(); ++i) {
            const auto [x, y] = meanShift(best);
            auto found = pairs(x, y, alikeOnly);
            if (found.size() < best.size()) break;
            best = std::move(found);
            tx = x;
            ty = y;
        }
        return best;
    }

    /// Strong regions that have a partner, over all strong regions of what both patches show.
    double score(const Indices& chosen, double tx, double ty) const {
        const auto a = strongOf(m_a, m_b, tx, ty), b = strongOf(m_b, m_a, -tx, -ty);
        const auto all = std::count(a.begin(), a.end(), 1) + std::count(b.begin(), b.end(), 1);
        if (all < 2 * kFewest) return 0;
        int matched = 0;
        for (const std::size_t k : chosen) matched += a[m_candidates[k].a] + b[m_candidates[k].b];
        return static_cast<double>(matched) / static_cast<double>(all);
    }

    const TCandidate& candidate(std::size_t k) const { return m_candidates[k]; }

 private:
    /// 1 for the most salient of the regions that lie on the other patch after the shift.
    std::vector<char> strongOf(const observations::TPatch& patch,
                               const observations::TPatch& other,
                               double tx,
                               double ty) const {
        std::vector<char> common(patch.regions.size());
        std::transform(patch.regions.begin(), patch.regions.end(), common.begin(),
                       [&](const auto& r) {
                           return std::abs(r.x + tx) <= other.width / 2 &&
                                  std::abs(r.y + ty) <= other.height / 2;
                       });
        const auto n = std::count(common.begin(), common.end(), 1);
        auto left = static_cast<long>(std::ceil(m_options.strong * static_cast<double>(n)));
        for (char& c : common) c = static_cast<char>(c != 0 && left-- > 0);
        return common;
    }

    void collect() {
        const auto looksA = regionLooks(m_a), looksB = regionLooks(m_b);
        const bool compare = !looksA.empty() && !looksB.empty();
        const double sizeVariance = mrpt::square(m_options.logScaleSigma);
        for (std::size_t i = 0; i < m_a.regions.size(); ++i)
            for (std::size_t j = 0; j < m_b.regions.size(); ++j) {
                const auto& a = m_a.regions[i];
                const auto& b = m_b.regions[j];
                const double size = mrpt::square(std::log(b.s / a.s)) / sizeVariance;
                if (!(size <= m_gate)) continue;
                const double own = mrpt::square(m_options.placeSigma) +
                                   mrpt::square(m_options.placeSigmaScales * std::min(a.s, b.s));
                const double varX = own + a.x * a.x * m_stretch.u;
                const double varY = own + a.y * a.y * m_stretch.v;
                const double dx = b.x - a.x, dy = b.y - a.y;
                if (std::abs(dx) > m_options.maxShift + std::sqrt(m_gate * varX) ||
                    std::abs(dy) > m_options.maxShift + std::sqrt(m_gate * varY))
                    continue;
                const bool alike =
                    compare && correlation(looksA[i], looksB[j]) >= m_options.correlation;
                m_candidates.push_back({i, j, dx, dy, varX, varY, size, alike});
            }
    }

    std::pair<double, double> meanShift(const Indices& chosen) const {
        double x = 0, y = 0, wx = 0, wy = 0;
        for (const std::size_t k : chosen) {
            const auto& c = m_candidates[k];
            x += c.dx / c.varX, wx += 1 / c.varX;
            y += c.dy / c.varY, wy += 1 / c.varY;
        }
        return {x / wx, y / wy};
    }

    const TRegionMatchOptions& m_options;
    const observations::TPatch& m_a;
    const observations::TPatch& m_b;
    double m_gate;
    TLengthErrors m_stretch;
    std::vector<TCandidate> m_candidates;
};

}  // namespace

TRegionAgreement matchRegions(const TRegionMatchOptions& options,
                              const observations::TPatch& a,
                              const observations::TPatch& b) {
    TRegionAgreement out;
    if (a.regions.empty() || b.regions.empty()) return out;
    const TLengthErrors ofA = lengthErrors(a), ofB = lengthErrors(b);
    if (!usable(a, ofA) || !usable(b, ofB)) return out;
    const CRegionPairing pairing(options, a, b, {ofA.u + ofB.u, ofA.v + ofB.v});
    Indices chosen = pairing.onCommonShift(true, out.tx, out.ty);
    out.score = out.supported = pairing.score(chosen, out.tx, out.ty);
    if (out.supported >= options.support) {
        chosen = pairing.pairs(out.tx, out.ty, false);
        out.score = pairing.score(chosen, out.tx, out.ty);
    }
    for (const std::size_t k : chosen)
        out.pairs.emplace_back(pairing.candidate(k).a, pairing.candidate(k).b);
    return out;
}

}  // namespace salma::appearance
