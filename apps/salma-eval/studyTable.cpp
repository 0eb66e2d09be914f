// SPDX-License-Identifier: BSD-3-Clause
#include "studyTable.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>
#include <set>

#include "poseConsistency.h"

namespace salma::apps {
namespace {

using Results = std::vector<const TRunResult*>;

constexpr auto kAll = "all";

/// Number of runs for which `holds`.
template <class TEST>
TProportion share(const Results& results, const TEST& holds) {
    std::size_t count = 0;
    for (const auto* result : results) count += holds(*result);
    return proportion(count, results.size());
}

/// Of all pairings or sightings of all runs together.
template <class COUNT>
TProportion pooled(const Results& results, const COUNT& counts) {
    std::size_t count = 0, total = 0;
    for (const auto* result : results) {
        const auto [one, all] = counts(result->score);
        count += one;
        total += all;
    }
    return proportion(count, total);
}

template <class VALUE>
TMean mean(const Results& results, const VALUE& valueOf) {
    std::vector<double> values;
    for (const auto* result : results)
        values.push_back(static_cast<double>(valueOf(result->score)));
    return meanInterval(values);
}

using Counts = std::pair<std::uint64_t, std::uint64_t>;

Counts pairings(const TKindScore& s) { return {s.right, s.judged}; }
Counts sightings(const TKindScore& s) { return {s.recalled, s.resightings}; }
Counts sum(const Counts& a, const Counts& b) { return {a.first + b.first, a.second + b.second}; }

void addAssociation(const Results& done, TStudyRow& row) {
    row.salientPrecision = pooled(done, [](const auto& s) { return pairings(s.salient); });
    row.cornerPrecision = pooled(done, [](const auto& s) { return pairings(s.corners); });
    row.precision =
        pooled(done, [](const auto& s) { return sum(pairings(s.salient), pairings(s.corners)); });
    row.salientRecall = pooled(done, [](const auto& s) { return sightings(s.salient); });
    row.cornerRecall = pooled(done, [](const auto& s) { return sightings(s.corners); });
    row.recall =
        pooled(done, [](const auto& s) { return sum(sightings(s.salient), sightings(s.corners)); });
    row.wrongSalient =
        mean(done, [](const auto& s) { return s.salient.wrong + s.salient.wrongWithFalse; });
    row.wrongCorners =
        mean(done, [](const auto& s) { return s.corners.wrong + s.corners.wrongWithFalse; });
    row.salientMade = mean(done, [](const auto& s) { return s.salient.made; });
    row.salientTrue = mean(done, [](const auto& s) { return s.salient.trueLandmarks; });
    row.salientDuplicates = mean(done, [](const auto& s) { return s.salient.duplicates; });
    row.cornersMade = mean(done, [](const auto& s) { return s.corners.made; });
    row.cornersTrue = mean(done, [](const auto& s) { return s.corners.trueLandmarks; });
    row.cornerDuplicates = mean(done, [](const auto& s) { return s.corners.duplicates; });
}

TNeesPoint neesPoint(const Results& done, std::size_t place) {
    TNeesPoint point;
    double sumOfNees = 0;
    for (const auto* result : done) {
        const auto& at = result->score.neesAt;
        if (place >= at.size() || std::isnan(at[place])) continue;
        sumOfNees += at[place];
        ++point.runs;
    }
    point.anees = point.low = point.high = std::numeric_limits<double>::quiet_NaN();
    if (point.runs == 0) return point;
    const double freedom = 3 * static_cast<double>(point.runs);
    const boost::math::chi_squared_distribution<double> chi2(freedom);
    point.anees = sumOfNees / freedom;
    point.low = boost::math::quantile(chi2, 0.025) / freedom;
    point.high = boost::math::quantile(chi2, 0.975) / freedom;
    return point;
}

void addConsistency(const Results& done, TStudyRow& row) {
    row.anees = mean(done, [](const auto& s) { return s.nees / 3; });
    std::size_t inside = 0, places = 0;
    for (std::size_t i = 0; i < TPoseConsistency::kParts; ++i) {
        const TNeesPoint point = neesPoint(done, i);
        row.neesCurve.push_back(point);
        places += point.runs > 0;
        inside += point.anees >= point.low && point.anees <= point.high;
    }
    row.neesInside = proportion(inside, places);
}

void addErrors(const Results& all, const Results& done, TStudyRow& row) {
    row.ate = mean(done, [](const auto& s) { return s.ate; });
    row.ateLastLap = mean(done, [](const auto& s) { return s.ateLastLap; });
    row.lastLapInPath = mean(done, [](const auto& s) { return s.lastLapInPath; });
    row.ateOdometry = mean(done, [](const auto& s) { return s.ateOdometry; });
    row.rpePosition = mean(done, [](const auto& s) { return s.rpePosition; });
    for (const auto* result : all) {
        const double error = result->score.ateLastLap;
        row.lastLapErrors.push_back(result->failed() || std::isnan(error)
                                        ? std::numeric_limits<double>::infinity()
                                        : error);
    }
    std::sort(row.lastLapErrors.begin(), row.lastLapErrors.end());
    row.medianAteLastLap = median(row.lastLapErrors);
}

TStudyRow figuresOf(const Results& all, const TStudyLimits& limits) {
    TStudyRow row;
    row.runs = all.size();
    Results done;
    std::copy_if(all.begin(), all.end(), std::back_inserter(done),
                 [](const auto* result) { return !result->failed(); });
    row.failed = all.size() - done.size();
    row.success = share(all, [&](const TRunResult& result) {
        return !result.failed() && succeeded(result.score, limits);
    });
    row.wrongLoop = share(done, [&](const auto& r) { return closedWrongLoop(r.score, limits); });
    row.wrongLoopWithCopies =
        share(done, [&](const auto& r) { return closedWrongLoopWithCopies(r.score, limits); });
    row.lost = share(done, [&](const auto& r) { return endedLost(r.score, limits); });
    row.noWrongPoster = share(done, [](const auto& r) { return r.score.salient.wrong == 0; });
    addAssociation(done, row);
    addErrors(all, done, row);
    addConsistency(done, row);
    double seconds = 0, steps = 0;
    for (const auto* result : done) {
        row.relocations += result->score.relocations;
        seconds += result->mappingSeconds;
        steps += static_cast<double>(result->score.steps);
    }
    row.cpuPerStep = seconds / steps;  // NaN without steps
    return row;
}

/// Groups in the order in which their first member stands.
class CGroups {
 public:
    CGroups(const std::vector<TRunResult>& results, const TStudyLimits& limits)
        : m_results(results), m_limits(limits) {}

    void addRows(bool allWorlds, bool allNoise, std::vector<TStudyRow>& rows) const {
        std::vector<std::pair<std::vector<std::string>, Results>> groups;
        for (const auto& result : m_results) {
            const std::vector<std::string> name{allWorlds ? kAll : result.key.world,
                                                allNoise ? kAll : result.key.noise,
                                                result.key.backend, result.key.method};
            const auto found = std::find_if(groups.begin(), groups.end(),
                                            [&](const auto& g) { return g.first == name; });
            auto& group = found != groups.end() ? *found : groups.emplace_back(name, Results());
            group.second.push_back(&result);
        }
        for (const auto& [name, members] : groups) {
            TStudyRow row = figuresOf(members, m_limits);
            row.world = name[0];
            row.noise = name[1];
            row.backend = name[2];
            row.method = name[3];
            rows.push_back(std::move(row));
        }
    }

 private:
    const std::vector<TRunResult>& m_results;
    const TStudyLimits& m_limits;
};

}  // namespace

bool endedLost(const TRunScore& score, const TStudyLimits& limits) {
    return !(score.finalError <= limits.doorSpacing / 2);
}

bool succeeded(const TRunScore& score, const TStudyLimits& limits) {
    return score.ateLastLap < limits.maxAte && !endedLost(score, limits);
}

bool closedWrongLoop(const TRunScore& score, const TStudyLimits& limits) {
    return score.repeatedWrongPairs > 0 || !(score.maxJump <= limits.doorSpacing / 2) ||
           endedLost(score, limits);
}

bool closedWrongLoopWithCopies(const TRunScore& score, const TStudyLimits& limits) {
    return closedWrongLoop(score, limits) && score.wrongCopies > 0;
}

std::vector<TStudyRow> studyTable(const std::vector<TRunResult>& results,
                                  const TStudyLimits& limits) {
    std::set<std::string> worlds, noise;
    for (const auto& result : results) {
        worlds.insert(result.key.world);
        noise.insert(result.key.noise);
    }
    const CGroups groups(results, limits);
    std::vector<TStudyRow> rows;
    groups.addRows(false, false, rows);
    if (worlds.size() > 1) groups.addRows(true, false, rows);
    if (noise.size() > 1) groups.addRows(worlds.size() > 1, true, rows);
    return rows;
}

}  // namespace salma::apps
