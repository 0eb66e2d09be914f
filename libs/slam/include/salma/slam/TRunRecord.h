// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/poses/CPose3D.h>
#include <salma/association/TAssociation.h>
#include <salma/association/TMeasurement.h>

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace salma::slam {

enum class EDecision { paired, created, deferred, clutter, relocated, provisional };

/// What the robot saw in a step, as the colours of Ho's fig 3.1 tell it.
enum class ESight { nothing, first, again };

struct TTrajectoryRow {
    double time{0};                //!< [s since 1970]
    mrpt::poses::CPose2D pose;     //!< T_w_r, as it is known when the run is over.
    mrpt::poses::CPose2D running;  //!< T_w_r, as the filter had it at that time.
    /// Of the running (x, y, heading) [m, rad].
    Eigen::Matrix3d covariance{Eigen::Matrix3d::Zero()};
    mrpt::poses::CPose2D odometry;  //!< T_o_r, odometry alone.
    ESight sight{ESight::nothing};
    std::optional<mrpt::poses::CPose3D> spatial;  //!< T_w_r of a filter in space.
};

/// A row of associations.csv. NaN stands for "has none" and is written as an empty cell.
struct TAssociationRow {
    double time{0};
    std::size_t observation{0};  //!< Index in its step.
    association::ELandmarkKind kind{association::ELandmarkKind::corner};
    double range{0};    //!< [m]
    double bearing{0};  //!< [rad]
    double u{0}, v{0};  //!< Centre in the picture [px]; NaN for a corner.
    /// From the camera's axis to the centre, to the right [rad]; NaN for a corner. Not written.
    double axisAngle{std::numeric_limits<double>::quiet_NaN()};
    EDecision decision{EDecision::clutter};
    int landmark{-1};           //!< Id; -1 for none.
    double distance2{0};        //!< Squared Mahalanobis distance to it; NaN for none.
    double logRatio{0};         //!< Log likelihood ratio of the appearance; NaN for none.
    std::size_t candidates{0};  //!< Landmarks inside its gate.
    /// Of the association; what is new by it may still be provisional.
    association::EReason reason{association::EReason::notFinite};
    std::shared_ptr<const observations::TPatch> patch{};  //!< As seen; null for a corner.
};

/// A row of candidates.csv: a landmark that an observation could be, or that is near it.
struct TCandidateRow {
    double time{0};
    std::size_t observation{0};
    int landmark{0};
    double distance2{0};
    double logRatio{0};  //!< NaN without appearance.
    bool chosen{false};
    bool inGate{true};  //!< False: only within `new_distance2`.
};

/// A row of innovations.csv.
struct TInnovationRow {
    double time{0};
    std::string component;  //!< "range_m", "bearing_deg" or "pitch_deg".
    double value{0};        //!< In the component's unit.
    double sigma{0};        //!< In the component's unit, from the innovation covariance.
};

/// A row of relocations.csv: a landmark that voted in an attempt to find the local map again.
struct TRelocationRow {
    double time{0};
    std::string outcome;  //!< "joined", "ambiguous", "unproved" or "refused".
    association::ELandmarkKind kind{association::ELandmarkKind::corner};
    int local{0}, left{0};  //!< Ids in the local map and in the one that was left behind.
    double distance{0};     //!< Between them after alignment [m].
    double logRatio{0};     //!< Of their appearance; NaN for corners.
    double shiftX{0}, shiftY{0}, turn{0};        //!< Of the robot by the alignment [m, rad].
    double posters{0}, corners{0}, odometry{0};  //!< What each says for the alignment [nats].
    double margin{0};                            //!< Lead over the second-best alignment [nats].
};

struct TMapLandmark {
    int id{0};
    association::ELandmarkKind kind{association::ELandmarkKind::corner};
    mrpt::math::TPoint2D mean;                            //!< [m], world.
    Eigen::Matrix2d covariance{Eigen::Matrix2d::Zero()};  //!< [m^2]
    /// Height and its deviation, of a filter in space [m]; NaN in the plane.
    double z{std::numeric_limits<double>::quiet_NaN()};
    double sigmaZ{std::numeric_limits<double>::quiet_NaN()};
    mrpt::math::TPoint2D firstMean;  //!< When it was first seen.
    Eigen::Matrix2d firstCovariance{Eigen::Matrix2d::Zero()};
    std::size_t sightings{0};
    double firstTime{0}, lastTime{0};                   //!< [s since 1970]
    std::shared_ptr<const observations::TPatch> patch;  //!< Null for a corner.
    /// Direction of the wall's normal towards the robot at creation [rad], world; NaN for none.
    double wallAngle{std::numeric_limits<double>::quiet_NaN()};
};

/// All that a run leaves; the files of a run folder are written from it alone.
struct TRunRecord {
    std::vector<TTrajectoryRow> trajectory;
    std::vector<TMapLandmark> landmarks;
    std::vector<TAssociationRow> associations;
    std::vector<TCandidateRow> candidates;
    std::vector<TInnovationRow> innovations;
    std::vector<TRelocationRow> relocations;  //!< Of attempts that found something.
    std::size_t joins{0};                     //!< Relocations that took effect.
    std::size_t removed{0};                   //!< Landmarks that were looked for in vain.
    bool smoothed{false};  //!< Path and map were estimated anew at the end, from all that was used.
    std::vector<mrpt::math::TPoint2D>
        scanPoints;  //!< Laser points at the estimated poses, thinned [m].
    std::vector<std::string> notices;
    std::size_t pictures{0};
    std::size_t picturesWithoutLandmark{0};
    /// Why regions, entities and pictures made no landmark, and how often.
    std::map<std::string, std::size_t> refused;
    std::size_t splitGroups{0};  //!< Groups of regions that lay on several planes.
    double seconds{0};           //!< Wall time of the run.
    std::uint32_t seed{0};
    std::string logFile;
    std::string options;  //!< Effective config.ini.
};

}  // namespace salma::slam
