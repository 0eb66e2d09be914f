// SPDX-License-Identifier: BSD-3-Clause
// place-classes: trains the classifier of places and measures it in random buildings.
#include <iostream>

#include "CPlacesApp.h"
#include "runProgram.h"

int main(int argc, char** argv) {
    CLI::App app("Trains the classifier of places and measures it in random buildings.",
                 "place-classes");
    salma::bench::CPlacesApp places(app);
    return salma::apps::runProgram(app,
                                   "  place-classes test\n"
                                   "  place-classes train --out libs/laser/src/placeModel.cpp\n",
                                   argc, argv, [&] { places.run(std::cout); });
}
