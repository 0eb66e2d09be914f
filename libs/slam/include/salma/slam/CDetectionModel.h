// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/TAssociationProblem.h>
#include <salma/slam/TDetectionOptions.h>
#include <salma/slam/TViews.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>

namespace salma::slam {

/// Where a landmark is believed to be, in the robot frame of a step.
struct TBelievedPlace {
    Eigen::Vector2d point{0, 0};                                 //!< [m]
    Eigen::Matrix2d covariance{Eigen::Matrix2d::Zero()};         //!< Of `point` [m^2].
    double wallAngle{std::numeric_limits<double>::quiet_NaN()};  //!< Of the wall's normal [rad].
    double wallAngleSigma{0};                                    //!< [rad]
};

/// In what reach a sensor measures that does not say where it looks.
struct TUnstatedView {
    double maxRange{40};      //!< [m]
    double halfField{M_PI};   //!< To both sides of straight ahead [rad].
    double probability{0.5};  //!< That a landmark in reach is measured.
};

/** How likely a step's sensors measure a landmark of the map, if it is where it is believed.
 *
 * A poster must lie in the camera's cone, on a wall that faces it, and be hidden by nothing that
 * the laser's rays end at; then the tables of [detection] by incidence and range hold. A corner
 * must lie in the scanner's field with its ray free; then the table by range holds. What the place
 * is not sure about widens the borders. Without a picture no poster is measured, without a scan no
 * corner. Source: own. */
class CDetectionModel {
 public:
    /// \throw std::invalid_argument if the tables do not fit.
    explicit CDetectionModel(const TDetectionOptions& options = {},
                             const TUnstatedView& unstated = {});

    /** Fills `detection` of all landmarks of a step's problem.
     *
     * Of a picture the front end takes `mostPosters` at most, so that the probabilities of all
     * posters together do not exceed that. Of steps that state no view (range-bearing records) each
     * landmark has the probability of the unstated view, times that of lying in it. */
    void state(const TViews& views, association::TAssociationProblem& problem) const;

    association::TDetectability poster(const TViews& views, const TBelievedPlace& place) const;
    association::TDetectability corner(const TViews& views, const TBelievedPlace& place) const;

    /// Probability that a picture shows a poster whole, from the front and not hidden.
    static double posterInView(const TViews& views, const TBelievedPlace& place);
    /// Probability that beams of this step's scan reach a corner.
    static double cornerInView(const TViews& views, const TBelievedPlace& place);
    /// True if all beams near a corner reach it.
    static bool showsCornerForSure(const TViews& views, const TBelievedPlace& place);

 private:
    association::TDetectability unstated(const Eigen::Vector2d& z,
                                         const Eigen::Matrix2d& covariance) const;

    TDetectionOptions m_options;
    TUnstatedView m_unstated;
};

}  // namespace salma::slam
