// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/slam/CSlamBackend.h>

#include <cstddef>
#include <vector>

namespace salma::bench {

/** Landmarks two by two along a hallway, named, and a robot that stands among them.
 *
 * A filter of any kind gets the same map by fill(), and then the same step again and again. */
struct TStepScene {
    static constexpr std::size_t seen = 10;  //!< Measurements of a step.
    static constexpr double reach = 8;       //!< Farther landmarks are not expected [m].

    std::vector<Eigen::Vector2d> landmarks;

    explicit TStepScene(std::size_t landmarks);

    /// Steps that show all landmarks once, from the start, some at a time.
    std::vector<slam::TStepInput> fill() const;
    /// A step of no motion in the middle of the hallway that shows the nearest.
    slam::TStepInput step() const;
    /// From the start to the middle of the hallway, without measurement.
    slam::TStepInput toTheMiddle() const;
};

}  // namespace salma::bench
