// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <salma/laser/CPlaceFilter.h>
#include <salma/simulator/CPlaceTruth.h>
#include <salma/simulator/TSensorOptions.h>

#include <cstdint>
#include <vector>

namespace salma::bench {

/// A scan in a random building, and what kind of place it shows.
struct TPlaceSample {
    mrpt::obs::CObservation2DRangeScan scan;
    simulator::TPlaceTruth truth;
    std::uint32_t building{0};                           //!< Seed.
    laser::EPlaceStep step{laser::EPlaceStep::goingOn};  //!< On a walk: before this scan.
};

simulator::TBuildingOptions trainingBuildings();
/// Wider spans, for choosing between ways to classify.
simulator::TBuildingOptions validationBuildings();
/// Wider still, for the figures; nothing was chosen by them.
simulator::TBuildingOptions testBuildings();

/// The LMS 200 of 1 deg in millimetre mode, its scanner at the robot's centre.
simulator::TLaserOptions placeLaser();

/// Poses drawn evenly over one building, at most `most` of each class and of each doubt.
std::vector<TPlaceSample> drawSamples(const simulator::TBuildingOptions& options,
                                      std::uint32_t seed,
                                      std::size_t most);

/// Scans of a robot that wanders through a building.
std::vector<TPlaceSample> drawWalk(const simulator::TBuildingOptions& options,
                                   std::uint32_t seed,
                                   std::size_t steps);

/// A step of a walk.
struct TPlaceStep {
    laser::EPlaceClass from, to;
    laser::EPlaceStep step;
};

/// The classes that a robot passes that wanders through a building; where a pose has no class of
/// its own, the last one that had counts.
std::vector<TPlaceStep> stepsOfWalk(const simulator::TBuildingOptions& options,
                                    std::uint32_t seed,
                                    std::size_t steps);

}  // namespace salma::bench
