// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>
#include <salma/slam/TRunRecord.h>

#include <vector>

#include "TTruth.h"

namespace salma::apps {

struct TTruthMatcherOptions : public config::TStrictOptions<TTruthMatcherOptions> {
    double maxSkew{0.001};                   //!< Between an observation and its picture [s].
    double maxPixels{60};                    //!< From the true centre in the picture [px].
    double maxRange{0.3};                    //!< From the true range [m].
    double maxBearing{0.05235987755982989};  //!< From the true bearing, 3 deg [rad].
    double maxCorner{0.3};                   //!< From the true corner [m].
    double maxGap{0.5};  //!< Longest gap of the true path to interpolate over [s].

    void visit(config::COptionVisitor& v);
    /// \throw std::invalid_argument unless each is positive and finite.
    void validate() const;
};

/** Says what an observation of a run really was.
 *
 * A salient one is the nearest sighting of its picture, within maxPixels in the picture or within
 * maxRange and maxBearing of the robot. A corner is the true corner nearest to where it was
 * observed from the robot's true pose. Several observations may be of one true landmark. */
class CTruthMatcher {
 public:
    /// `truth` must outlive this object. \throw std::invalid_argument
    CTruthMatcher(const TTruthMatcherOptions& options, const TTruth& truth);

    /// Id of the true landmark; -1 for none, and for every corner where the true path is unknown.
    int match(const slam::TAssociationRow& row) const;

    /// True if the truth holds corners and the path of the robot.
    bool knowsCorners() const;

 private:
    int matchSalient(const slam::TAssociationRow& row) const;
    int matchCorner(const slam::TAssociationRow& row) const;

    TTruthMatcherOptions m_options;
    const TTruth& m_truth;
};

/// The rows of an associations.csv. \throw std::runtime_error, std::invalid_argument
std::vector<slam::TAssociationRow> readAssociations(const std::string& file);

}  // namespace salma::apps
