// SPDX-License-Identifier: BSD-3-Clause
// How well CPatchMatcher tells posters apart: figures of docs/recognition.md.
#include <salma/appearance/CPatchDescriptor.h>
#include <salma/appearance/CPatchMatcher.h>
#include <salma/appearance/CRegionDescriptor.h>
#include <salma/appearance/CTexture.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "CPosterViews.h"
#include "CScores.h"
#include "pictureSets.h"

namespace {

using namespace salma;

using bench::kPosterHeight;
using bench::kWalls;

constexpr std::size_t kMinKeypoints = 12;  // as [front_end] has it
constexpr std::size_t kOtherStep = 4;      // every fourth pair of views of different posters
constexpr int kAngleBins = 5;
constexpr double kMissed = -10;  // log ratio of a pair of which a view was refused

struct TArguments {
    std::string set{"report"};
    std::uint32_t views{48};
    std::uint32_t seed{1};
};

struct TSight {
    std::optional<observations::TPatch> patch;  //!< Nothing: refused.
    std::size_t poster{0};
    double incidence{0};
};

/// Adds up the time of named steps.
class CStopwatch {
 public:
    template <class STEP>
    auto time(const std::string& name, STEP step) {
        const auto start = std::chrono::steady_clock::now();
        auto result = step();
        auto& [seconds, calls] = m_steps[name];
        seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        ++calls;
        return result;
    }
    void print() const {
        for (const auto& [name, total] : m_steps)
            std::printf("  %-14s %8.3f ms, mean of %zu\n", name.c_str(),
                        1e3 * total.first / static_cast<double>(total.second), total.second);
    }

 private:
    std::map<std::string, std::pair<double, std::size_t>> m_steps;
};

class CRecognition {
 public:
    explicit CRecognition(const TArguments& arguments)
        : m_arguments(arguments), m_names(bench::pictureSet(arguments.set)) {}

    void run() {
        for (std::size_t i = 0; i < m_names.size(); ++i) look(i);
        std::printf(
            "%zu posters of %.1f m height, %u views each, seed %u; views refused %zu of "
            "%zu (%s)\n",
            m_names.size(), kPosterHeight, m_arguments.views, m_arguments.seed, refused(),
            m_sights.size(), reasons().c_str());
        compare();
        reportScores();
        reportPlaceAlone();
        reportTextures();
        std::printf("times\n");
        m_watch.print();
    }

 private:
    void look(std::size_t poster) {
        const bench::CPosterViews views(
            bench::pictureFile(SALMA_DATA_DIR, m_names[poster]), kWalls[poster % kWalls.size()],
            kPosterHeight, 1000 * m_arguments.seed + static_cast<std::uint32_t>(poster));
        for (std::uint32_t i = 0; i < m_arguments.views; ++i) {
            const auto view = m_watch.time("render", [&] { return views.view(i); });
            m_sights.push_back({described(view), poster, view.incidence});
        }
    }

    std::optional<observations::TPatch> described(const bench::TPosterView& view) {
        auto result = m_watch.time(
            "rectify", [&] { return m_rectifier.rectify(view.grey, view.seen, view.cut); });
        if (!result.patch) return refuse(view, asString(result.refusal));
        auto& patch = *result.patch;
        patch.keypoints =
            m_watch.time("describe SIFT", [&] { return m_descriptor.describe(patch); });
        patch.regions = m_watch.time(
            "second look", [&] { return m_secondLook.describe(view.grey, view.seen, view.cut); });
        patch.texture = m_watch.time(
            "texture", [&] { return m_texture.describe(view.grey, view.seen, view.cut); });
        if (!appearance::saysEnough(patch, kMinKeypoints)) return refuse(view, "too few keypoints");
        return std::move(result.patch);
    }

    std::optional<observations::TPatch> refuse(const bench::TPosterView& view,
                                               const std::string& reason) {
        ++m_reasons[reason];
        std::printf("  %s refused from %.1f m, %.0f deg, %.0f px/m: %s\n",
                    m_names[m_sights.size() / m_arguments.views].c_str(), view.distance,
                    mrpt::RAD2DEG(view.incidence),
                    view.truth.pixelsPerMetre((view.place.u0 + view.place.u1) / 2,
                                              (view.place.v0 + view.place.v1) / 2),
                    reason.c_str());
        return std::nullopt;
    }

    std::size_t refused() const {
        std::size_t n = 0;
        for (const auto& [reason, count] : m_reasons) n += count;
        return n;
    }

    std::string reasons() const {
        std::string text;
        for (const auto& [reason, count] : m_reasons)
            text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + reason;
        return text.empty() ? "none" : text;
    }

    /// Calls f(a, b) for all pairs of one poster and every kOtherStep-th pair of two.
    template <class FUNCTION>
    void forPairs(FUNCTION f) const {
        for (std::size_t i = 0; i < m_sights.size(); ++i)
            for (std::size_t j = i + 1; j < m_sights.size(); ++j)
                if (m_sights[i].poster == m_sights[j].poster || (i + j) % kOtherStep == 0)
                    f(m_sights[i], m_sights[j]);
    }

    void compare() {
        forPairs([&](const TSight& a, const TSight& b) {
            const bool same = a.poster == b.poster;
            appearance::TPatchMatch match;
            if (a.patch && b.patch)
                match = m_watch.time(same ? "match same" : "match other",
                                     [&] { return m_matcher.match(*a.patch, *b.patch); });
            else if (!same)
                return;  // a refused pair of one poster counts as missed, of two as nothing
            const bool lost = !a.patch || !b.patch;
            m_regionScores.add(a.poster, b.poster, match.regionScore);
            m_keypointScores.add(a.poster, b.poster, match.keypointScore);
            m_agree.add(a.poster, b.poster, match.regionsAgree);
            m_ratiosOrMissed.add(a.poster, b.poster, lost ? kMissed : match.logLikelihoodRatio);
            m_accepted.add(a.poster, b.poster, match.logLikelihoodRatio > 0);
            if (lost) return;
            m_ratios.add(a.poster, b.poster, match.logLikelihoodRatio);
            m_scores.add(a.poster, b.poster, match.score);
            const auto bin = static_cast<std::size_t>(
                std::min(kAngleBins - 1.0,
                         std::abs(a.incidence - b.incidence) / mrpt::DEG2RAD(130.0) * kAngleBins));
            if (same) m_byAngle[bin].push_back(match);
        });
    }

    static void print(const char* name, const bench::TFigure& f, double factor, const char* unit) {
        std::printf("  %-30s %9.5f%s (95 %%: %.5f to %.5f)\n", name, factor * f.value, unit,
                    factor * f.low, factor * f.high);
    }

    void reportScores() const {
        const auto seed = m_arguments.seed;
        std::printf("pairs: same %zu, other %zu\n", m_scores.same().size(),
                    m_scores.other().size());
        print("region score, same", m_regionScores.meanOfSame(seed), 100, " %");
        print("region score, other", m_regionScores.meanOfOther(seed), 100, " %");
        print("regions agree, same", m_agree.meanOfSame(seed), 100, " %");
        print("regions agree, other", m_agree.meanOfOther(seed), 100, " %");
        print("log ratio > 0, same", m_accepted.meanOfSame(seed), 100, " %");
        print("log ratio > 0, other", m_accepted.meanOfOther(seed), 100, " %");
        print("area under curve, log ratio", m_ratios.areaUnderCurve(seed), 1, "");
        print("  with refused pairs as missed", m_ratiosOrMissed.areaUnderCurve(seed), 1, "");
        print("area under curve, regions", m_regionScores.areaUnderCurve(seed), 1, "");
        print("area under curve, keypoints", m_keypointScores.areaUnderCurve(seed), 1, "");
        reportMostAlike();
        std::printf(
            "by difference of viewing angle: pairs, region score, keypoint score, "
            "log ratio > 0\n");
        for (std::size_t bin = 0; bin < kAngleBins; ++bin) reportAngle(bin);
        reportReliability();
    }

    /// The two different posters with the highest region score.
    void reportMostAlike() const {
        std::size_t first = 0, second = 1;
        for (std::size_t a = 0; a < m_names.size(); ++a)
            for (std::size_t b = a + 1; b < m_names.size(); ++b)
                if (m_regionScores.meanOf(a, b) > m_regionScores.meanOf(first, second)) {
                    first = a;
                    second = b;
                }
        std::printf("most alike: %s and %s, region score %.3f, log ratio > 0 in %.4f\n",
                    m_names[first].c_str(), m_names[second].c_str(),
                    m_regionScores.meanOf(first, second), m_accepted.meanOf(first, second));
    }

    void reportAngle(std::size_t bin) const {
        double regions = 0, keypoints = 0, found = 0;
        const auto n = static_cast<double>(m_byAngle[bin].size());
        for (const auto& match : m_byAngle[bin]) {
            regions += match.regionScore / n;
            keypoints += match.keypointScore / n;
            found += (match.logLikelihoodRatio > 0 ? 1 : 0) / n;
        }
        std::printf("  %3zu to %3zu deg  %6zu  %.3f  %.3f  %.4f\n", 26 * bin, 26 * (bin + 1),
                    m_byAngle[bin].size(), regions, keypoints, found);
    }

    /// What the table says of a score, and what is counted.
    void reportReliability() const {
        std::printf("score: same, other, log of the ratio of their shares, table\n");
        const auto same = m_scores.same(), other = m_scores.other();
        const std::vector<double> limits{-1, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.6, 1};
        for (std::size_t k = 1; k < limits.size(); ++k) {
            const auto in = [&](const std::vector<double>& scores) {
                return std::count_if(scores.begin(), scores.end(),
                                     [&](double s) { return s > limits[k - 1] && s <= limits[k]; });
            };
            const double s = static_cast<double>(in(same)), o = static_cast<double>(in(other));
            std::printf(
                "  up to %.2f  %6.0f  %6.0f  %6.2f  %6.2f\n", limits[k], s, o,
                std::log(s / static_cast<double>(same.size()) /
                         (o / static_cast<double>(other.size()))),
                m_matcher.logLikelihoodRatio((std::max(0.0, limits[k - 1]) + limits[k]) / 2));
        }
    }

    /// Ho's measure, place and size alone, and the level of chance: regions of another poster put
    /// anywhere on it. Here extents do not decide which patches are compared.
    void reportPlaceAlone() {
        appearance::TRegionMatchOptions options;
        options.sameExtent = 0;
        const appearance::CPatchMatcher full({}, options);
        options.correlation = -1;  // any two look alike
        const appearance::CPatchMatcher placeOnly({}, options);
        const std::size_t posters = m_names.size();
        bench::CScores all(posters), place(posters), chance(posters), placeChance(posters);
        std::mt19937 random(m_arguments.seed);
        forPairs([&](const TSight& a, const TSight& b) {
            if (!a.patch || !b.patch) return;
            all.add(a.poster, b.poster, full.match(*a.patch, *b.patch).regionScore);
            place.add(a.poster, b.poster, placeOnly.match(*a.patch, *b.patch).regionScore);
            if (a.poster == b.poster) return;
            auto moved = *b.patch;
            std::uniform_real_distribution<double> unit(-0.5, 0.5);
            for (auto& region : moved.regions) {
                region.x = moved.width * unit(random);
                region.y = moved.height * unit(random);
            }
            chance.add(a.poster, b.poster, full.match(*a.patch, moved).regionScore);
            placeChance.add(a.poster, b.poster, placeOnly.match(*a.patch, moved).regionScore);
        });
        const auto seed = m_arguments.seed;
        std::printf("whatever the extents\n");
        print("region score, same", all.meanOfSame(seed), 100, " %");
        print("region score, other", all.meanOfOther(seed), 100, " %");
        print("region score, other, shuffled", chance.meanOfOther(seed), 100, " %");
        std::printf("whatever the extents, place and size alone\n");
        print("region score, same", place.meanOfSame(seed), 100, " %");
        print("region score, other", place.meanOfOther(seed), 100, " %");
        print("region score, other, shuffled", placeChance.meanOfOther(seed), 100, " %");
        print("area under curve", place.areaUnderCurve(seed), 1, "");
    }

    void reportTextures() const {
        std::array<std::array<std::vector<double>, kWalls.size()>, kWalls.size()> distances;
        forPairs([&](const TSight& a, const TSight& b) {
            if (!a.patch || !b.patch) return;
            const auto d = appearance::textureDistance(a.patch->texture, b.patch->texture);
            auto i = a.poster % kWalls.size(), j = b.poster % kWalls.size();
            if (i > j) std::swap(i, j);
            if (d) distances[i][j].push_back(*d);
        });
        std::printf("texture of the wall: median distance (5 %%, 95 %%)\n");
        for (std::size_t i = 0; i < kWalls.size(); ++i)
            for (std::size_t j = i; j < kWalls.size(); ++j)
                std::printf("  %-8s %-8s %.3f (%.3f, %.3f) of %zu\n", kWalls[i], kWalls[j],
                            bench::quantile(distances[i][j], 0.5),
                            bench::quantile(distances[i][j], 0.05),
                            bench::quantile(distances[i][j], 0.95), distances[i][j].size());
    }

    TArguments m_arguments;
    std::vector<std::string> m_names;
    std::vector<TSight> m_sights;
    std::map<std::string, std::size_t> m_reasons;
    appearance::CRectifier m_rectifier;
    appearance::CPatchDescriptor m_descriptor;
    appearance::CRegionDescriptor m_secondLook;
    appearance::CTexture m_texture;
    appearance::CPatchMatcher m_matcher;
    bench::CScores m_regionScores{m_names.size()}, m_keypointScores{m_names.size()},
        m_ratios{m_names.size()}, m_ratiosOrMissed{m_names.size()}, m_scores{m_names.size()},
        m_agree{m_names.size()}, m_accepted{m_names.size()};
    std::array<std::vector<appearance::TPatchMatch>, kAngleBins> m_byAngle;
    CStopwatch m_watch;
};

}  // namespace

int main(int argc, char** argv) {
    TArguments arguments;
    CLI::App app("region score, keypoint score and log likelihood ratio of simulated views");
    app.add_option("--set", arguments.set, "of pictures")
        ->check(CLI::IsMember(bench::pictureSetNames()))
        ->capture_default_str();
    app.add_option("--views", arguments.views, "of each poster")->capture_default_str();
    app.add_option("--seed", arguments.seed, "of the views")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    try {
        CRecognition(arguments).run();
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "recognition: %s\n", e.what());
        return 1;
    }
}
