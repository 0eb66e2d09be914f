// SPDX-License-Identifier: BSD-3-Clause
#include <salma/slam/TEkfOptions.h>

namespace salma::slam {

void TEkfOptions::visit(config::COptionVisitor& v) {
    v.choice("state", state, {{"2d", EState::plane}, {"6d", EState::space}},
             "pose in the plane or in space; 6d takes range-bearing records alone");
    v.choice(
        "update", update, {{"block", EUpdate::block}, {"mrpt", EUpdate::mrpt}},
        "own step with a covariance per measurement, or the step of MRPT's filter (always in 6d)");
    v.flag("smooth", smooth,
           "at the end estimate path and map anew from all that was measured (block)");
    v.flag("ignore_identities", ignoreIdentities, "do not read the identities in the log");
    v.number("max_range_m", maxRange, config::moreThan(0),
             "distance up to which landmarks are expected to be seen");
    v.degrees("field_of_view_deg", fieldOfView, {0, 360, true},
              "angle, centred ahead, in which landmarks are expected to be seen");
    v.integer("min_sightings_corner", minSightingsCorner, config::atLeast(1),
              "steps in which a corner must be seen before it becomes a landmark");
    v.number("provisional_radius_m", provisionalRadius, config::moreThan(0),
             "distance within which sightings of a corner not yet in the map belong together");
    v.integer("provisional_steps", provisionalSteps, config::atLeast(1),
              "steps with corners after which a corner not yet in the map is forgotten");
    v.integer("max_patches", maxPatches, config::atLeast(1),
              "views of a salient landmark that are kept");
    v.degrees("patch_spread_deg", patchSpread, config::between(0, 90),
              "least difference in viewing angle between two kept views");
    v.degrees("decorrelation_deg", decorrelation, config::between(0, 180),
              "appearance counts again in one track after this change of the viewing angle");
    v.number("remove_after", removeAfter, config::atLeast(0),
             "landmarks go that were looked for in vain so long [nats], 0: never (saliency)");
    v.number("track_gap_s", trackGap, config::atLeast(0),
             "a landmark not paired for longer begins another track");
}

}  // namespace salma::slam
