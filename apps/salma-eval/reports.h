// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/viz/CTrajectoryScore.h>

#include <optional>
#include <string>

#include "CAssociationScore.h"

namespace salma::apps {

struct TAssociationReport {
    std::string truthName;
    TAssociationFigures salient;
    std::optional<TAssociationFigures> corners;  //!< Nothing where their truth is unknown.
};

/// Figures for a reader. Metres and degrees.
std::string trajectoryTable(const viz::TTrajectoryFigures& figures,
                            const viz::TScoreOptions& options);
std::string associationTable(const TAssociationReport& report);

/// The same as JSON; every key that is not dimensionless ends in its unit.
std::string trajectoryJson(const viz::TTrajectoryFigures& figures,
                           const viz::TScoreOptions& options);
std::string associationJson(const TAssociationReport& report);

}  // namespace salma::apps
