// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/TAssociation.h>
#include <salma/slam/CLandmarkTable.h>
#include <salma/slam/CSlamBackend.h>
#include <salma/slam/TRunRecord.h>

namespace salma::slam {

/// \throw std::invalid_argument if `step` is not finite or its vectors' sizes do not agree.
void checkStep(const TStepInput& step);

/// What the filter does after that verdict, unless it holds the measurement back.
EDecision decisionOf(association::EVerdict verdict);

/// What became of a measurement of a step. \param landmark Its id, -1 for none.
TAssociationRow associationRow(const TStepInput& step,
                               std::size_t measurement,
                               EDecision decision,
                               const association::TDecision& details,
                               int landmark);

/// The innovation of a paired measurement. \param nu Range [m] and bearing [rad], as sigma.
void addInnovation(double time,
                   const Eigen::Vector2d& nu,
                   const Eigen::Vector2d& sigma,
                   std::vector<TInnovationRow>& rows);

/// All but place and covariance, with the most frontal view.
TMapLandmark mapLandmarkOf(const TLandmark& landmark);

}  // namespace salma::slam
