// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <meanInterval.h>
#include <proportion.h>

#include <string>
#include <vector>

#include "TRunScore.h"

namespace salma::apps {

/// What counts as success, and as a wrong loop.
struct TStudyLimits {
    double maxAte{0.3};       //!< Of the last lap, for success [m].
    double doorSpacing{2.5};  //!< A robot that is off by more than half of it is lost [m].
};

/// Whether the robot ended nearer to the next door than to its own. Source: own.
bool endedLost(const TRunScore& score, const TStudyLimits& limits);

/// Whether the last lap is right in itself, and where the map of the first one has it.
bool succeeded(const TRunScore& score, const TStudyLimits& limits);

/// Whether a run ended with its map on a wrong place. Source: own.
bool closedWrongLoop(const TRunScore& score, const TStudyLimits& limits);

/// Whether in such a run a poster was taken for one of its copies; not whether that was the cause.
bool closedWrongLoopWithCopies(const TRunScore& score, const TStudyLimits& limits);

/// ANEES at one place of the course: the mean over runs of the NEES there, divided by 3.
struct TNeesPoint {
    std::size_t runs{0};
    double anees{0};         //!< NaN without runs; 1 is expected.
    double low{0}, high{0};  //!< Where it is with 95 % if all runs are consistent.
};

/// Figures of the runs of one group; "all" stands for worlds or levels put together.
struct TStudyRow {
    std::string world, noise, backend, method;
    std::size_t runs{0}, failed{0};              //!< A failed run has no score, and is no success.
    TProportion success;                         //!< Of all runs.
    TProportion wrongLoop, lost, noWrongPoster;  //!< Of the runs that did not fail; so below.
    TProportion wrongLoopWithCopies;
    TProportion precision, salientPrecision, cornerPrecision;
    TProportion recall, salientRecall, cornerRecall;
    TMean wrongSalient, wrongCorners;  //!< Wrong pairings of a run.
    TMean salientMade, salientTrue, cornersMade, cornersTrue;
    TMean salientDuplicates, cornerDuplicates;
    TMean ate, ateLastLap, lastLapInPath, ateOdometry, rpePosition;  //!< [m]
    double medianAteLastLap{0};                                      //!< [m]
    TMean anees;  //!< Of the runs' mean NEES / 3. Steps of a run are not independent: runs are.
    TProportion neesInside;  //!< Places of the course whose ANEES is inside its 95 % region.
    std::size_t relocations{0};
    double cpuPerStep{0};  //!< Processor time of association and filter [s]; not in the tables.
    std::vector<TNeesPoint> neesCurve;  //!< [TPoseConsistency::kParts]
    std::vector<double> lastLapErrors;  //!< ATE of the last lap, increasing; failed runs: infinity.

    /// Calls visit(name, field) for what the tables hold.
    template <class SELF, class VISITOR>
    static void forEach(SELF& s, const VISITOR& visit) {
        visit("world", s.world);
        visit("noise", s.noise);
        visit("backend", s.backend);
        visit("method", s.method);
        visit("runs", s.runs);
        visit("failed", s.failed);
        visit("success", s.success);
        visit("wrong_loop", s.wrongLoop);
        visit("wrong_loop_with_copies", s.wrongLoopWithCopies);
        visit("lost", s.lost);
        visit("no_wrong_poster", s.noWrongPoster);
        visit("precision", s.precision);
        visit("precision_salient", s.salientPrecision);
        visit("precision_corner", s.cornerPrecision);
        visit("recall", s.recall);
        visit("recall_salient", s.salientRecall);
        visit("recall_corner", s.cornerRecall);
        visit("wrong_salient_per_run", s.wrongSalient);
        visit("wrong_corner_per_run", s.wrongCorners);
        visit("salient_made", s.salientMade);
        visit("salient_true", s.salientTrue);
        visit("salient_duplicates", s.salientDuplicates);
        visit("corners_made", s.cornersMade);
        visit("corners_true", s.cornersTrue);
        visit("corner_duplicates", s.cornerDuplicates);
        visit("ate_m", s.ate);
        visit("ate_last_lap_m", s.ateLastLap);
        visit("ate_last_lap_median_m", s.medianAteLastLap);
        visit("last_lap_in_path_m", s.lastLapInPath);
        visit("ate_odometry_m", s.ateOdometry);
        visit("rpe_1m_m", s.rpePosition);
        visit("anees", s.anees);
        visit("nees_inside", s.neesInside);
        visit("relocations", s.relocations);
    }
};

/** One row for each world, noise, back end and method, in the order of `results`; then rows that
 * put worlds together, and levels of noise too, where there are several. */
std::vector<TStudyRow> studyTable(const std::vector<TRunResult>& results,
                                  const TStudyLimits& limits);

}  // namespace salma::apps
