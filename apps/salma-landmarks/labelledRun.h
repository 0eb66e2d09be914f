// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CTruthMatcher.h>
#include <TSlamConfig.h>
#include <salma/association/TMeasurement.h>
#include <salma/observations/TPatch.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace salma::apps {

/// An entity of the front end that shows a true poster.
struct TSeenPoster {
    double time{0};  //!< Of the picture [s since 1970].
    int poster{0};   //!< Its id in the truth.
    std::string texture;
    double angle{0};  //!< From the wall's normal to the robot, counter-clockwise, measured [rad].
    observations::TPatch patch;
};

/// A true poster whose centre was in a picture, or a true corner in a scan, and not hidden.
struct TTrueView {
    association::ELandmarkKind kind{association::ELandmarkKind::salient};
    std::string thing;    //!< Texture of the poster, or world and id of the corner.
    double incidence{0};  //!< Between the poster's normal and the direction to the camera [rad].
    double range{0};      //!< From camera or scanner [m].
    double inView{1};     //!< What CDetectionModel makes of the view: probability.
    bool seen{false};     //!< The front end took the poster; the scan had the corner.
};

/// What the front end saw in a simulated log, named by the truth.
struct TLabelledRun {
    std::string folder;
    std::size_t pictures{0};
    std::size_t strangers{0};       //!< Entities that show no true poster; not used.
    std::vector<TSeenPoster> seen;  //!< In the order of time.
    std::vector<TTrueView> views;   //!< Of the pictures that the front end looked at, and scans.
};

/** Looks for corners in all scans, and runs the front end over the pictures of a folder that
 * salma-sim wrote, or takes the records that its X.salient.rawlog holds, and names each entity by
 * truth geometry. \throw std::runtime_error, std::invalid_argument naming file, line and value: no
 * or several truths, malformed tables, no rawlog, no poster in the truth, none seen. */
TLabelledRun labelRun(const std::filesystem::path& folder, const TSlamConfig& config);

}  // namespace salma::apps
