// SPDX-License-Identifier: BSD-3-Clause
// salma-sim: drives a robot through a world file and writes its rawlog with the truth.
#include "CSimApp.h"

int main(int argc, char** argv) {
    salma::apps::CSimApp app;
    return app.run(argc, argv);
}
