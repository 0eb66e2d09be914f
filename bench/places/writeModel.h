// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/laser/CPlaceClassifier.h>
#include <salma/laser/CPlaceFilter.h>

#include <ostream>

namespace salma::bench {

/// Writes libs/laser/src/placeModel.cpp. Weights keep four digits.
void writeModel(const laser::TPlaceNetwork& network,
                const laser::TPlaceTransitions& transitions,
                std::ostream& out);

}  // namespace salma::bench
