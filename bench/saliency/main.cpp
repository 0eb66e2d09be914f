// SPDX-License-Identifier: BSD-3-Clause
// saliency-speed: how long scale saliency takes, beside SIFT and MSER on the same pictures.
#include <iostream>

#include "CSaliencySpeedApp.h"
#include "runProgram.h"

int main(int argc, char** argv) {
    CLI::App app("Times scale saliency, its plain loops, cv::SIFT and cv::MSER, interleaved.",
                 "saliency-speed");
    salma::bench::CSaliencySpeedApp bench(app);
    return salma::apps::runProgram(
        app,
        "  saliency-speed --sizes 640x480 --out out/saliency-speed\n"
        "  saliency-speed --data ../shared/data --repetitions 20 --out out/saliency-speed\n",
        argc, argv, [&] { bench.run(std::cout); });
}
