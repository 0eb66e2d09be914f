// SPDX-License-Identifier: BSD-3-Clause
// salma-calib: a camera's lens, and where the camera sits beside the laser.
#include <iostream>

#include "CCameraCommand.h"
#include "CLaserCameraCommand.h"
#include "CTsaiCommand.h"
#include "runProgram.h"

int main(int argc, char** argv) {
    CLI::App app("Calibrates cameras, and a camera with a 2-D laser.", "salma-calib");
    app.require_subcommand(1);
    salma::apps::CCameraCommand camera(app);
    salma::apps::CTsaiCommand tsai(app);
    salma::apps::CLaserCameraCommand laserCamera(app);
    return salma::apps::runProgram(
        app,
        "  salma-calib camera left*.jpg --board 9x6 --square-m 0.025 --out out/camera\n"
        "  salma-calib laser-camera *.png --scans scans.txt --camera out/camera/camera.ini --board "
        "9x6 --square-m 0.09 --out out/laser-camera\n",
        argc, argv, [&] {
            if (camera.isChosen()) camera.run(std::cout);
            if (tsai.isChosen()) tsai.run(std::cout);
            if (laserCamera.isChosen()) laserCamera.run(std::cout);
        });
}
