// SPDX-License-Identifier: BSD-3-Clause
#include <salma/slam/TRelocationOptions.h>

namespace salma::slam {

void TRelocationOptions::visit(config::COptionVisitor& v) {
    v.flag("use", use, "look for the local map in the map that was left behind");
    v.degrees("anchor_deg", anchorSigma, config::moreThan(0),
              "sigma of the heading from which covariances are stated from the robot anew");
    v.number("unsure_m", unsure, config::moreThan(0),
             "landmarks not used within gap_m are not paired if predicted with a larger sigma");
    v.number("local_travel_m", localTravel, config::moreThan(0),
             "landmarks first seen within this travel are the local map");
    v.number("gap_m", gap, config::atLeast(0),
             "travel between it and the landmarks that it is compared with");
    v.number("every_m", every, config::moreThan(0), "travel between two attempts");
    v.number("propose", propose, config::anyNumber(),
             "least score of an alignment by the local map that is judged by all since [nats]");
    v.number("accept", accept, config::anyNumber(), "least score of an alignment [nats]");
    v.number("margin", margin, config::atLeast(0), "least lead over the second-best one [nats]");
    v.number("drift_factor", driftFactor, config::atLeast(1),
             "odometry may err so many times as much as is stated");
    v.number("drift_outlier", driftOutlier, config::insideOf(0, 1),
             "probability that the pose is lost altogether");
    v.number("overlooked", overlooked, config::insideOf(0, 1),
             "share of the posters in view that a whole pass does not find");
    v.number("geometry_cap", geometryCap, config::atLeast(0),
             "what corners alone say against a new place, at most [nats]");
    v.number("pair_radius_m", pairRadius, config::moreThan(0),
             "landmarks that may be one lie so near after alignment");
}

}  // namespace salma::slam
