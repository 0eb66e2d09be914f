// SPDX-License-Identifier: BSD-3-Clause
#include "runScore.h"

#include <salma/viz/CRunWriter.h>
#include <salma/viz/CTrajectoryScore.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <tuple>

#include "CTruthMatcher.h"
#include "poseConsistency.h"

namespace salma::apps {
namespace {

using association::ELandmarkKind;

std::size_t countKind(const TTruth& truth, ELandmarkKind kind) {
    return static_cast<std::size_t>(std::count_if(truth.landmarks.begin(), truth.landmarks.end(),
                                                  [&](const auto& l) { return l.kind == kind; }));
}

TKindScore kindScore(const TAssociationFigures& f) {
    TKindScore s;
    s.right = f.precision.count;
    s.judged = f.precision.total;
    s.recalled = f.recall.count;
    s.resightings = f.recall.total;
    s.wrong = f.wrong.size();
    s.wrongWithFalse = f.wrongWithFalse;
    s.deferred = f.deferred;
    s.made = f.landmarksMade;
    s.trueLandmarks = f.trueLandmarks;
    s.covered = f.landmarksCovered;
    s.duplicates = f.duplicateLandmarks();
    s.falseLandmarks = f.falseLandmarks;
    return s;
}

/// Landmarks that stand for one true landmark and were paired with one other in several steps.
std::uint64_t repeatedWrongPairs(const TAssociationFigures& figures) {
    std::map<std::pair<int, int>, std::set<double>> times;
    for (const auto& w : figures.wrong) times[{w.landmark, w.observationTruth}].insert(w.time);
    return static_cast<std::uint64_t>(std::count_if(
        times.begin(), times.end(), [](const auto& pair) { return pair.second.size() > 1; }));
}

/// Pairings of a poster with another one that has the same texture.
std::uint64_t wrongCopies(const TAssociationFigures& figures, const TTruth& truth) {
    std::map<int, std::string> textures;
    for (const auto& landmark : truth.landmarks) textures[landmark.id] = landmark.texture;
    return static_cast<std::uint64_t>(
        std::count_if(figures.wrong.begin(), figures.wrong.end(), [&](const TWrongPairing& wrong) {
            const std::string& texture = textures[wrong.landmarkTruth];
            return !texture.empty() && texture == textures[wrong.observationTruth];
        }));
}

std::uint64_t relocations(const slam::TRunRecord& record) {
    std::set<double> times;
    for (const auto& row : record.associations)
        if (row.decision == slam::EDecision::relocated) times.insert(row.time);
    return times.size();
}

/// When the last lap begins: the last 1/laps of the path's length [s].
double lastLapStart(const viz::TTrajectory& path, int laps) {
    std::vector<double> length(path.size(), 0);
    for (std::size_t i = 1; i < path.size(); ++i)
        length[i] = length[i - 1] + path[i].T_w_r.distanceTo(path[i - 1].T_w_r);
    const double begin = length.back() * (laps - 1) / laps;
    const auto first = std::lower_bound(length.begin(), length.end(), begin);
    return path[static_cast<std::size_t>(first - length.begin())].time;
}

/// RMSE of position of the poses from `start` [s] on, moved by T_ref_est [m].
double rmseSince(double start,
                 const viz::TTrajectory& estimate,
                 const mrpt::poses::CPose2D& T_ref_est,
                 const viz::TTrajectory& reference,
                 double maxGap) {
    double squares = 0;
    std::size_t n = 0;
    for (const auto& [time, pose] : estimate) {
        mrpt::poses::CPose2D there;
        if (time < start || !viz::interpolate(reference, time, maxGap, there)) continue;
        const double error = (T_ref_est + pose).distanceTo(there);
        squares += error * error;
        ++n;
    }
    return n == 0 ? TRunScore::kNone : std::sqrt(squares / static_cast<double>(n));
}

}  // namespace

std::map<ELandmarkKind, TAssociationFigures> associationFigures(
    const std::vector<slam::TAssociationRow>& rows,
    const TTruth& truth,
    const CTruthMatcher& matcher) {
    std::map<ELandmarkKind, CAssociationScore> scores;
    for (const auto& row : rows) scores[row.kind].add(row, matcher.match(row));
    std::map<ELandmarkKind, TAssociationFigures> figures;
    for (const auto kind : {ELandmarkKind::salient, ELandmarkKind::corner})
        figures[kind] = scores[kind].figures(countKind(truth, kind));
    return figures;
}

TRunScore scoreRun(const slam::TRunRecord& record, const TTruth& truth, int laps) {
    if (!truth.path) throw std::invalid_argument(truth.name + ": the true path is not known");
    const auto estimate = viz::estimatedPath(record);
    const viz::TScoreOptions options;
    const viz::CTrajectoryScore score(options);
    const auto figures = score.compare(*truth.path, estimate);
    TRunScore s;
    s.steps = record.trajectory.size();
    s.ate = figures.aligned.rmse;
    const double lastLap = lastLapStart(*truth.path, laps);
    const auto first = std::lower_bound(estimate.begin(), estimate.end(), lastLap,
                                        [](const auto& p, double time) { return p.time < time; });
    s.ateLastLap = score.compare(*truth.path, viz::TTrajectory(first, estimate.end())).aligned.rmse;
    s.lastLapInPath = rmseSince(lastLap, estimate, figures.T_ref_est, *truth.path, options.maxGap);
    s.ateOdometry = score.compare(*truth.path, viz::odometryPath(record)).aligned.rmse;
    s.rpePosition = figures.perMetres.translation.rmse;
    s.rpeHeading = figures.perMetres.rotation.rmse;

    const auto consistency = poseConsistency(record, *truth.path, options.maxGap);
    s.nees = consistency.meanNees;
    s.neesSteps = consistency.steps;
    s.neesAt = consistency.at;
    s.finalError = consistency.finalError;
    s.maxJump = consistency.maxJump;

    auto kinds = associationFigures(record.associations, truth,
                                    CTruthMatcher(TTruthMatcherOptions(), truth));
    s.salient = kindScore(kinds[ELandmarkKind::salient]);
    s.corners = kindScore(kinds[ELandmarkKind::corner]);
    s.repeatedWrongPairs = repeatedWrongPairs(kinds[ELandmarkKind::salient]);
    s.wrongCopies = wrongCopies(kinds[ELandmarkKind::salient], truth);
    s.relocations = relocations(record);
    return s;
}

}  // namespace salma::apps
