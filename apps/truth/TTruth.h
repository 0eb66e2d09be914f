// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <salma/association/TMeasurement.h>
#include <salma/viz/TTrajectory.h>

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace salma::apps {

struct TTrueLandmark {
    int id{0};
    association::ELandmarkKind kind{association::ELandmarkKind::salient};
    mrpt::math::TPoint2D position;  //!< [m], world of the truth.
    /// Of a salient one only: direction of its normal [rad], and what is printed on it.
    double yaw{std::numeric_limits<double>::quiet_NaN()};
    std::string texture{};
};

/// A true landmark as the robot saw it.
struct TTrueSighting {
    double time{0};  //!< Of the picture or scan [s since 1970].
    int landmark{0};
    association::ELandmarkKind kind{association::ELandmarkKind::salient};
    double u{0}, v{0};  //!< Its centre in the picture [px]; NaN for a corner.
    double range{0};    //!< [m], from the robot.
    double bearing{0};  //!< [rad], from the robot.
};

/// What the simulator knows about a log: NAME.landmarks.csv, NAME.sightings.csv, NAME.gt.tum.
struct TTruth {
    std::string name;
    std::vector<TTrueLandmark> landmarks;
    std::vector<TTrueSighting> sightings;  //!< Sorted by time.
    std::optional<viz::TTrajectory> path;  //!< Where the robot really was, if that is known.
};

/** \param name NAME of the files; may be empty where the folder holds one only.
 * \throw std::runtime_error or std::invalid_argument naming file, line and value if there is no
 * such truth, if it is ambiguous or if a file is malformed. */
TTruth loadTruth(const std::filesystem::path& folder, const std::string& name);

}  // namespace salma::apps
