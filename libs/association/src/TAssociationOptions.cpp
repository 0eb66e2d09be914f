// SPDX-License-Identifier: BSD-3-Clause
#include <salma/association/TAssociationOptions.h>

#include <stdexcept>

namespace salma::association {

void TAssociationOptions::visit(config::COptionVisitor& v) {
    v.choice("method", method,
             {{"nn", EMethod::nn},
              {"scnn", EMethod::scnn},
              {"jcbb", EMethod::jcbb},
              {"saliency", EMethod::saliency}},
             "nearest neighbour, sequential or joint compatibility, or with appearance");
    v.number("gate_quantile", gateQuantile, config::insideOf(0, 1),
             "probability that a true pairing passes the individual gate");
    v.number("joint_quantile", jointQuantile, config::insideOf(0, 1),
             "the same for all pairings of a step together (all but nn)");
    v.number("new_distance2", newDistance2, config::atLeast(0),
             "squared Mahalanobis distance of a new landmark from all others");
    v.number("wall_angle_quantile", wallAngleQuantile, config::insideOf(0, 1),
             "probability that the right wall passes the test of its angle");
    v.number("accept_log_lr", acceptLogLr, config::anyNumber(),
             "log likelihood ratio from which appearance proves a candidate (saliency)");
    v.number("forbid_log_lr", forbidLogLr, config::anyNumber(),
             "log likelihood ratio up to which appearance excludes a candidate (saliency)");
    v.number("margin", margin, config::atLeast(0),
             "least lead in nats over the second-best hypothesis (saliency)");
    v.number("corner_log_density", cornerLogDensity, config::anyNumber(),
             "log density of corners not in the map, per metre and radian (saliency)");
    v.number("salient_log_density", salientLogDensity, config::anyNumber(),
             "the same for salient landmarks (saliency)");
    v.number("corner_clutter_log_density", cornerClutterLogDensity, config::anyNumber(),
             "log density of corners that stand for nothing (saliency)");
    v.number("salient_clutter_log_density", salientClutterLogDensity, config::anyNumber(),
             "the same for salient landmarks (saliency)");
    v.number("detection_probability", detectionProbability, config::insideOf(0, 1),
             "probability that a landmark in reach of a sensor without a stated view is measured, "
             "0.5 for "
             "no matter (saliency, rbpf)");
    v.integer(
        "search_limit", searchLimit, config::atLeast(1),
        "pairings judged before random starts (jcbb) or the surest first (saliency) take over");
    v.integer("seed", seed, config::atLeast(0), "of the random starts (jcbb)");
    v.integer("max_measurements", maxMeasurements, config::atLeast(1),
              "measurements of a step that are looked at, the nearest ones");
}

void TAssociationOptions::validate() const {
    checkRanges();
    if (!(forbidLogLr < acceptLogLr))
        throw std::invalid_argument(
            "forbid_log_lr = " + std::to_string(forbidLogLr) +
            " must be smaller than accept_log_lr = " + std::to_string(acceptLogLr));
}

}  // namespace salma::association
