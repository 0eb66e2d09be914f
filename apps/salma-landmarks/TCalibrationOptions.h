// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>

#include <cmath>

namespace salma::apps {

/// What `salma-landmarks calibrate` itself decides; shown by its --print-config.
struct TCalibrationOptions : public config::TStrictOptions<TCalibrationOptions> {
    int bins{20};          //!< Of the score, equal, over [0, 1].
    double priorCount{1};  //!< Sightings of each kind that the bins begin with, spread evenly.
    double perPoster{3};   //!< Independent sightings that a poster, or a pair of posters, is worth.
    double spoiltRate{0.05};      //!< Share of views of the same that look like another's.
    double trackGap{10};          //!< A poster not seen for longer begins another track [s].
    double angleStep{M_PI / 36};  //!< Width of a bin of viewing-angle change [rad].
    double independent{0.2};      //!< Correlation up to which two views count as independent.
    int minPairs{100};            //!< Fewer pairs in a bin of angles say nothing.

    void visit(config::COptionVisitor& v) {
        v.integer("bins", bins, config::between(4, 200), "of the score, over [0, 1]");
        v.number("prior_count", priorCount, config::moreThan(0),
                 "sightings of each kind that the bins begin with, spread evenly");
        v.number("per_poster", perPoster, config::moreThan(0),
                 "independent sightings that a poster, or a pair of posters, is worth");
        v.number("spoilt_rate", spoiltRate, config::insideOf(0, 1),
                 "share of views of the same that look like another's: glare, people in front");
        v.number("track_gap_s", trackGap, config::moreThan(0),
                 "a poster not seen for longer begins another track");
        v.degrees("angle_step_deg", angleStep, config::between(0.5, 45),
                  "width of a bin of viewing-angle change");
        v.number("independent", independent, config::insideOf(0, 1),
                 "correlation up to which two views count as independent");
        v.integer("min_pairs", minPairs, config::atLeast(2),
                  "fewer pairs in a bin of angles say nothing");
    }
};

}  // namespace salma::apps
