// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/appearance/CPatchMatcher.h>
#include <salma/association/TAssociationOptions.h>
#include <salma/landmarks/CFrontEnd.h>
#include <salma/landmarks/CWideBaselineTracker.h>
#include <salma/laser/CCornerExtractor.h>
#include <salma/laser/CLineExtractor.h>
#include <salma/laser/CPlaceString.h>
#include <salma/laser/CWallOdometry.h>
#include <salma/slam/CLandmarkMapSetup.h>
#include <salma/slam/COdometryNoise.h>
#include <salma/slam/TDetectionOptions.h>
#include <salma/slam/TEkfOptions.h>
#include <salma/slam/TRbpfOptions.h>
#include <salma/slam/TRelocationOptions.h>
#include <salma/slam/TSlipOptions.h>
#include <salma/slam/rangeBearing.h>

#include <cmath>
#include <string>

namespace salma::apps {

enum class EBackend { ekf, rbpf };

/// Section [run] of config.ini.
struct TRunOptions : public config::TStrictOptions<TRunOptions> {
    EBackend backend{EBackend::ekf};
    std::string rawlog;  //!< Log to read if the command line names none.
    int threads{0};      //!< For the pictures; 0: one per core. The result does not depend on it.
    bool corners{true};  //!< Laser corners are landmarks.
    double scanDistance{0.05};     //!< A scan is used after this much travel [m] ...
    double scanTurn{M_PI / 36};    //!< ... or after this much turning since the one before [rad].
    double unknownMotion{0.5};     //!< Without odometry: sigma of the motion in one second [m].
    double unknownTurn{M_PI / 6};  //!< Without odometry: sigma of the turn in one second [rad].

    void visit(config::COptionVisitor& v);
};

/// All of config.ini, one member a section.
struct TSlamConfig {
    TRunOptions run;
    laser::TLineOptions lines;
    laser::TCornerOptions corners;
    laser::TPlaceStringOptions placeString;
    laser::TWallOdometryOptions wallOdometry;
    landmarks::TSeeingOptions seeing;
    appearance::TMatcherOptions matcher;
    appearance::TRegionMatchOptions regionMatcher;
    association::TAssociationOptions association;
    landmarks::TTrackingOptions tracking;
    slam::TEkfOptions ekf;
    slam::TDetectionOptions detection;
    slam::TRelocationOptions relocation;
    slam::TSlipOptions slip;
    slam::TRbpfOptions rbpf;
    slam::TOdometryOptions odometry;
    slam::TRangeBearingOptions rangeBearing;

    /// True if the filter works in space: it takes range-bearing records alone.
    bool isSpatial() const {
        return run.backend == EBackend::ekf && ekf.state == slam::EState::space;
    }

    /// \throw std::invalid_argument naming file, section, key and value of the first mistake.
    static TSlamConfig load(const std::string& file);

    /// The whole file with every key, its value, meaning and range.
    std::string asIni() const;
};

}  // namespace salma::apps
