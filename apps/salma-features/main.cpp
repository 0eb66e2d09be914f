// SPDX-License-Identifier: BSD-3-Clause
// salma-features: what is salient in pictures, and whether two pictures show the same.
#include <iostream>

#include "CDetectCommand.h"
#include "CMatchCommand.h"
#include "runProgram.h"

int main(int argc, char** argv) {
    CLI::App app("Finds salient regions in pictures and compares pictures.", "salma-features");
    app.require_subcommand(1);
    salma::apps::CDetectCommand detect(app);
    salma::apps::CMatchCommand match(app);
    return salma::apps::runProgram(
        app,
        "  salma-features detect corridor.jpg --out out/features\n"
        "  salma-features match poster-left.jpg poster-right.jpg --out out/match\n",
        argc, argv, [&] {
            if (detect.isChosen()) detect.run(std::cout);
            if (match.isChosen()) match.run(std::cout);
        });
}
