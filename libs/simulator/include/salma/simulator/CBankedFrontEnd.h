// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/landmarks/CFrontEnd.h>
#include <salma/laser/CLineExtractor.h>
#include <salma/laser/CPlaceString.h>
#include <salma/observations/CObservationSalientLandmarks.h>
#include <salma/simulator/CSightingBank.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace salma::simulator {

class CSimulator;

/// The walls that the laser sees, at the time of a picture.
struct TWallsInView {
    mrpt::obs::CObservation2DRangeScan scan;  //!< The nearest in time.
    laser::TLineResult lines;                 //!< In the robot frame at the scan's time.
    std::vector<laser::TLine> walls;          //!< In the robot frame at the picture's time.
};

/// What the scan nearest to picture `index` shows; nothing within `maxSkew` [s]. The robot's motion
/// between both is that of odometry with medium noise, whatever the run's own level: records are
/// those of a front end that has worked once for runs of all levels.
std::optional<TWallsInView> wallsInView(const CSimulator& drive, std::size_t index, double maxSkew);

/** Stands for camera and front end in a run without pictures: gives the record that they would.
 *
 * For each picture one of the bank's views from the same place is drawn. What was seen in it is
 * moved to where this run's camera and laser have it: the ray to the place in the world that the
 * banked patch showed, cut with the wall that this run's laser sees. Covariances are those of the
 * new geometry; regions, keypoints and texture are the banked ones, stretched as the laser's error
 * stretches them. A patch that somebody walking hides, or whose wall the laser does not see, is
 * left out. */
class CBankedFrontEnd {
 public:
    CBankedFrontEnd(std::shared_ptr<const CSightingBank> bank, std::uint32_t seed);

    /** \return The record of picture `index`, without stamp; null if no scan is near it in time.
     * \throw std::runtime_error if the bank holds no view from near there. */
    observations::CObservationSalientLandmarks::Ptr look(const CSimulator& drive,
                                                         std::size_t index) const;

 private:
    TBankedView drawn(const CSimulator& drive, std::size_t index) const;
    std::optional<observations::TPatch> moved(const CSimulator& drive,
                                              double time,
                                              const TBankedSighting& sighting,
                                              const std::vector<laser::TLine>& walls) const;

    std::shared_ptr<const CSightingBank> m_bank;
    std::uint32_t m_seed;
    landmarks::CFrontEnd m_frontEnd;
    laser::CPlaceString m_placeString;
    double m_margin{landmarks::TSelectionOptions().wallMargin};  //!< Walls go on beyond their ends.
};

}  // namespace salma::simulator
