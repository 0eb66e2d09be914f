// SPDX-License-Identifier: BSD-3-Clause
#include "detectionTables.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <tuple>

namespace salma::apps {
namespace {

using association::ELandmarkKind;

constexpr double kDegrees = 180 / M_PI;
constexpr double kSurest = 0.999;              // that a table may say while it is learned
constexpr double kLeast = 0.01, kMost = 0.99;  // that is believed of it: as the association does
constexpr int kSweeps = 500, kSections = 40;
constexpr double kGain = 1e-7;  // of a sweep over all knots, that ends them [nats]

/// Where a value lies among ascending knots.
struct TBetween {
    std::size_t lower{0}, upper{0};
    double share{0};  //!< Of the upper one.
};

TBetween between(const std::vector<double>& knots, double x) {
    if (!(x > knots.front())) return {0, 0, 0};
    if (x >= knots.back()) return {knots.size() - 1, knots.size() - 1, 0};
    const auto upper =
        static_cast<std::size_t>(std::upper_bound(knots.begin(), knots.end(), x) - knots.begin());
    return {upper - 1, upper, (x - knots[upper - 1]) / (knots[upper] - knots[upper - 1])};
}

double read(const std::vector<double>& values, const TBetween& at) {
    return values[at.lower] + at.share * (values[at.upper] - values[at.lower]);
}

/// So many looks from one place.
struct TLook {
    TBetween incidence, range;
    double inView{1};
    double found{0}, missed{0};  //!< Weights.
};

/// The product of two tables.
class CProduct {
 public:
    CProduct(std::size_t incidences, std::size_t ranges, double start)
        : m_byIncidence(incidences, std::sqrt(start)), m_byRange(ranges, std::sqrt(start)) {}

    /// Most likely values, knot by knot: the likelihood is concave in each of them.
    void fit(const std::vector<TLook>& looks) {
        const auto near = [&](std::size_t knots, auto place) {
            std::vector<std::vector<const TLook*>> result(knots);
            for (const TLook& look : looks) {
                const TBetween& at = look.*place;
                result[at.lower].push_back(&look);
                if (at.upper != at.lower) result[at.upper].push_back(&look);
            }
            return result;
        };
        const auto byIncidence = near(m_byIncidence.size(), &TLook::incidence);
        const auto byRange = near(m_byRange.size(), &TLook::range);
        double before = likelihood(looks);
        for (int sweep = 0; sweep < kSweeps; ++sweep) {
            for (std::size_t k = 0; k < m_byIncidence.size(); ++k)
                climb(byIncidence[k], m_byIncidence[k]);
            for (std::size_t k = 0; k < m_byRange.size(); ++k) climb(byRange[k], m_byRange[k]);
            const double now = likelihood(looks);
            if (!(now - before > kGain)) break;
            before = now;
        }
        const double top = *std::max_element(m_byRange.begin(), m_byRange.end());
        for (double& value : m_byRange) value /= top;
        for (double& value : m_byIncidence) value *= top;
    }

    const std::vector<double>& byIncidence() const { return m_byIncidence; }
    const std::vector<double>& byRange() const { return m_byRange; }

 private:
    double logProbability(const TLook& look) const {
        const double p = std::min(
            look.inView * read(m_byIncidence, look.incidence) * read(m_byRange, look.range),
            kSurest);
        return look.found * std::log(p) + look.missed * std::log1p(-p);
    }

    double likelihood(const std::vector<TLook>& looks) const {
        double sum = 0;
        for (const TLook& look : looks) sum += logProbability(look);
        return sum;
    }

    /// Golden section over the value of one knot.
    void climb(const std::vector<const TLook*>& looks, double& value) const {
        const double golden = (std::sqrt(5.0) - 1) / 2;
        const auto at = [&](double x) {
            value = x;
            double sum = 0;
            for (const TLook* look : looks) sum += logProbability(*look);
            return sum;
        };
        double low = 1e-4, high = kSurest;
        double a = high - golden * (high - low), b = low + golden * (high - low);
        double atA = at(a), atB = at(b);
        for (int i = 0; i < kSections; ++i) {
            if (atA < atB) {
                low = a;
                a = b;
                atA = atB;
                atB = at(b = low + golden * (high - low));
            } else {
                high = b;
                b = a;
                atB = atA;
                atA = at(a = high - golden * (high - low));
            }
        }
        value = (low + high) / 2;
    }

    std::vector<double> m_byIncidence, m_byRange;
};

std::vector<const TTrueView*> viewsOf(const std::vector<TLabelledRun>& runs, ELandmarkKind kind) {
    std::vector<const TTrueView*> views;
    for (const auto& run : runs)
        for (const auto& view : run.views)
            if (view.kind == kind && view.inView > kLeast) views.push_back(&view);
    return views;
}

/// One thing's views from between the same knots weigh `perPoster` at most; the prior is spread
/// over all pairs of knots.
std::vector<TLook> weighed(const std::vector<const TTrueView*>& views,
                           const std::vector<double>& incidences,
                           const std::vector<double>& ranges,
                           const TCalibrationOptions& options) {
    std::map<std::tuple<std::string, std::size_t, std::size_t>, double> counts;
    std::vector<TLook> looks;
    const auto placed = [&](const TTrueView& view) {
        return TLook{between(incidences, view.incidence * kDegrees), between(ranges, view.range),
                     view.inView, 0, 0};
    };
    const auto cell = [&](const TTrueView& view, const TLook& look) -> double& {
        return counts[{view.thing, look.incidence.lower, look.range.lower}];
    };
    for (const auto* view : views) ++cell(*view, placed(*view));
    double found = 0, all = 0;
    for (const auto* view : views) {
        TLook look = placed(*view);
        const double weight = std::min(1.0, options.perPoster / cell(*view, look));
        (view->seen ? look.found : look.missed) = weight;
        found += look.found;
        all += weight;
        looks.push_back(look);
    }
    const double prior =
        options.priorCount / static_cast<double>(std::max(incidences.size(), ranges.size()));
    for (std::size_t i = 0; i < incidences.size(); ++i) {
        const double share = found / all * std::cos(incidences[i] / kDegrees);
        for (std::size_t j = 0; j < ranges.size(); ++j)
            looks.push_back({{i, i, 0}, {j, j, 0}, 1, prior * share, prior * (1 - share)});
    }
    return looks;
}

/// As a file holds it.
std::vector<double> rounded(std::vector<double> values, double factor) {
    for (double& value : values) value = std::round(100 * factor * value) / 100;
    return values;
}

}  // namespace

slam::TDetectionOptions learnDetection(const std::vector<TLabelledRun>& runs,
                                       const slam::TDetectionOptions& configured,
                                       const TCalibrationOptions& options) {
    slam::TDetectionOptions result = configured;
    const auto posters = viewsOf(runs, ELandmarkKind::salient);
    if (!posters.empty()) {
        CProduct product(configured.incidence.size(), configured.range.size(), 0.5);
        product.fit(weighed(posters, configured.incidence, configured.range, options));
        result.byIncidence = rounded(product.byIncidence(), 1 - options.spoiltRate);
        result.byRange = rounded(product.byRange(), 1);
    }
    const auto corners = viewsOf(runs, ELandmarkKind::corner);
    if (!corners.empty()) {
        CProduct product(1, configured.cornerRange.size(), 0.5);
        product.fit(weighed(corners, {0}, configured.cornerRange, options));
        result.byCornerRange = rounded(product.byRange(), product.byIncidence()[0]);
    }
    result.validate();
    return result;
}

TDetectionLoss detectionLoss(const std::vector<TLabelledRun>& runs,
                             ELandmarkKind kind,
                             const slam::TDetectionOptions& learned,
                             const slam::TDetectionOptions& configured) {
    TDetectionLoss loss;
    const auto lossOf = [kind](const TTrueView& view, const slam::TDetectionOptions& tables) {
        const double found = kind == ELandmarkKind::salient
                                 ? tables.probability(view.incidence, view.range)
                                 : tables.cornerProbability(view.range);
        const double p = std::clamp(view.inView * found, kLeast, kMost);
        return view.seen ? -std::log(p) : -std::log1p(-p);
    };
    for (const auto* view : viewsOf(runs, kind)) {
        ++loss.views;
        loss.found += view->seen ? 1U : 0U;
        loss.learned += lossOf(*view, learned);
        loss.configured += lossOf(*view, configured);
    }
    if (loss.views > 0) {
        loss.learned /= static_cast<double>(loss.views);
        loss.configured /= static_cast<double>(loss.views);
    }
    return loss;
}

}  // namespace salma::apps
