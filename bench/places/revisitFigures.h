// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/laser/CRevisitModel.h>
#include <salma/simulator/CBuilding.h>

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace salma::bench {

/// The prior that buildings explored before give.
laser::TPlaceMatrix priorOfBuildings(const simulator::TBuildingOptions& options,
                                     std::uint32_t seed,
                                     int buildings);

/// One step of a robot in a building of which half is mapped.
struct TRevisitStep {
    std::uint32_t building;
    int walk, step;
    double outside;  //!< As the model says.
    bool truth;
};

struct TRevisitTrial {
    laser::TRevisitOptions options;
    int walks{10};
    int steps{60};  //!< Of 1 m, or from one corridor into the next.
};

std::vector<TRevisitStep> walkHalfMapped(const simulator::TBuildingOptions& options,
                                         std::uint32_t seed,
                                         const laser::TPlaceMatrix& prior,
                                         const TRevisitTrial& trial);

/// Accuracy, Brier score and a table of how often the model is right at what it says.
void writeRevisitFigures(const std::vector<TRevisitStep>& steps, std::ostream& out);

/// The same as a picture, with two walks beside it.
void plotRevisit(const std::vector<TRevisitStep>& steps, const std::string& file);

}  // namespace salma::bench
