// SPDX-License-Identifier: BSD-3-Clause
// MRPT's range-bearing logs through MRPT's filters and salma's, as the tables of
// docs/association.md.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <utility>

#include "salmaRun.h"
#include "stockRun.h"

namespace {

using namespace salma;
using association::EMethod;
using bench::EStockMethod;

void print(const std::string& method, const bench::TDemoScore& s) {
    std::printf("| %s | %zu | %zu | %.4f | %.4f | %.2f |\n", method.c_str(), s.landmarks,
                s.duplicates, s.pathRms, s.landmarkRms, s.millisecondsPerStep);
    std::fflush(stdout);
}

using StockRun = bench::TDemoRun (*)(const bench::TDemo&, const std::string&, EStockMethod);

void race(const std::string& stem,
          const std::string& ini,
          StockRun stock,
          const apps::TSlamConfig& base) {
    const auto demo = bench::TDemo::read(stem);
    std::printf("\n%s, %zu true landmarks, %zu frames\n\n", demo.rawlog.c_str(),
                demo.landmarks.size(), demo.path.size());
    std::printf(
        "| method | landmarks | duplicates | path RMS [m] | landmark RMS [m] | ms a step |\n"
        "|---|---|---|---|---|---|\n");
    for (const auto& [name, method] :
         {std::pair("MRPT, identities", EStockMethod::identities),
          std::pair("MRPT, nn", EStockMethod::nn), std::pair("MRPT, JCBB", EStockMethod::jcbb)})
        print(name, score(demo, stock(demo, ini, method)));
    apps::TSlamConfig config = base;
    print("salma, identities", score(demo, runSalma(demo, config)));
    config.ekf.ignoreIdentities = true;
    for (const auto& [name, method] :
         {std::pair("salma, nn", EMethod::nn), std::pair("salma, scnn", EMethod::scnn),
          std::pair("salma, jcbb", EMethod::jcbb),
          std::pair("salma, saliency", EMethod::saliency)}) {
        config.association.method = method;
        print(name, score(demo, runSalma(demo, config)));
    }
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("MRPT's range-bearing logs, MRPT's filters beside salma's");
    std::string config = SALMA_SOURCE_DIR "/config.ini";
    std::string share = "/usr/share/mrpt";
    app.add_option("--config", config, "options of salma's filters");
    app.add_option("--mrpt", share, "where the package mrpt-common has its files");
    CLI11_PARSE(app, argc, argv);
    try {
        apps::TSlamConfig base = apps::TSlamConfig::load(config);
        const std::string logs = share + "/datasets/";
        const std::string inis = share + "/config_files/kf-slam/";
        race(logs + "kf-slam_demo", inis + "EKF-SLAM_test_2d.ini", bench::runStock2D, base);
        base.ekf.state = slam::EState::space;
        race(logs + "kf-slam_6D_demo_DA", inis + "EKF-SLAM_6D_test_datassoc.ini", bench::runStock3D,
             base);
        race(logs + "kf-slam_6D_demo", inis + "EKF-SLAM_6D_test.ini", bench::runStock3D, base);
    } catch (const std::exception& e) {
        std::cerr << "kf-slam-race: " << e.what() << "\n";
        return 1;
    }
}
