// SPDX-License-Identifier: BSD-3-Clause
// salma-slam: reads a rawlog, finds and associates landmarks, leaves trajectory, map and report.
#include <iostream>

#include "CSlamApp.h"
#include "backend.h"
#include "runProgram.h"

int main(int argc, char** argv) {
    salma::apps::TSlamArguments arguments;
    bool printConfig = false;
    CLI::App app("Maps a building from a rawlog with laser, pictures and odometry.", "salma-slam");
    app.add_option("CONFIG", arguments.config, "ini file, such as config.ini");
    app.add_option("RAWLOG", arguments.rawlog, "log to read; else `rawlog` in [run]");
    app.add_option("--out", arguments.out, "folder for the results; replaced if it holds some");
    app.add_option("--backend", arguments.backend, "ekf or rbpf")
        ->check(CLI::IsMember(salma::apps::backendNames()));
    app.add_option("--association", arguments.association, "nn, scnn, jcbb or saliency")
        ->check(CLI::IsMember(salma::apps::methodNames()));
    app.add_option("--seed", arguments.seed, "seed of all random steps")
        ->check(CLI::NonNegativeNumber);
    app.add_flag("--ignore-ids", arguments.ignoreIdentities, "identities in the log are not read");
    app.add_option("--require", arguments.require,
                   "fail if the log has no laser, pictures, odometry")
        ->delimiter(',')
        ->check(CLI::IsMember({"laser", "pictures", "odometry"}));
    auto* save = app.add_flag("--save-rawlog", arguments.saveRawlog,
                              "keep the front end's records beside the results");
    app.add_flag("--embed", arguments.embed, "keep them in one file with the log")->needs(save);
    app.add_flag("--accept-truncated", arguments.acceptTruncated,
                 "take what is whole of a log that breaks off");
    app.add_flag("--print-config", printConfig, "print every key of CONFIG (or its default), stop");
    return salma::apps::runProgram(
        app,
        "  salma-slam config.ini rawlogs/hallway-loop.rawlog --out out/hallway\n"
        "  salma-slam config.ini my.rawlog --association nn --out out/nn\n",
        argc, argv, [&] {
            if (printConfig) {
                std::cout << (arguments.config.empty()
                                  ? salma::apps::TSlamConfig()
                                  : salma::apps::TSlamConfig::load(arguments.config))
                                 .asIni();
                return;
            }
            if (arguments.config.empty()) throw CLI::RequiredError("CONFIG");
            if (arguments.out.empty()) throw CLI::RequiredError("--out");
            salma::apps::CSlamApp slam;
            slam.initialize(arguments);
            slam.run();
            std::cout << slam.summary();
        });
}
