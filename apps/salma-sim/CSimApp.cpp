// SPDX-License-Identifier: BSD-3-Clause
#include "CSimApp.h"

#include <COutputFolder.h>
#include <CProgressBar.h>
#include <runProgram.h>
#include <salma/simulator/CBankBuilder.h>
#include <salma/simulator/CSimulator.h>

#include <iomanip>
#include <iostream>
#include <map>
#include <opencv2/core/utility.hpp>

namespace salma::apps {

using simulator::EOdometryNoise;
using simulator::EPictureSize;

namespace {

constexpr auto kExamples =
    "  salma-sim share/worlds/hallway-loop.ini --out out/hallway\n"
    "  salma-sim share/worlds/hallway-loop.ini --out out/high --seed 7 --laps 3 "
    "--odometry-noise high --camera attend";

const std::map<std::string, EOdometryNoise> kNoise = {{"low", EOdometryNoise::low},
                                                      {"medium", EOdometryNoise::medium},
                                                      {"high", EOdometryNoise::high}};
const std::map<std::string, EPictureSize> kSizes = {{"768x492", EPictureSize::evi768x492},
                                                    {"640x480", EPictureSize::vga640x480}};

template <class ENUM>
std::vector<std::string> namesOf(const std::map<std::string, ENUM>& all) {
    std::vector<std::string> names;
    names.reserve(all.size());
    for (const auto& entry : all) names.push_back(entry.first);
    return names;
}

void report(const simulator::TSimulationSummary& s, const std::string& out) {
    std::cout << std::fixed << std::setprecision(1) << "drove " << s.duration << " s: ";
    if (s.salientRecords > 0)
        std::cout << s.salientRecords << " records drawn from the bank, ";
    else
        std::cout << s.pictures << " pictures, ";
    std::cout << s.scans << " scans, " << s.odometryRecords << " odometry and " << s.panTiltRecords
              << " pan/tilt records\n"
              << std::setprecision(2) << "raw odometry ends " << s.odometryMiss
              << " m from the truth; laser offset " << std::setprecision(1) << s.laserOffset * 1000
              << " mm\n"
              << "written to " << out << "\n";
}

}  // namespace

int CSimApp::run(int argc, char** argv) {
    CLI::App app("Drives a robot through WORLD.ini and writes its rawlog with pictures and truth.",
                 "salma-sim");
    app.add_option("WORLD", m_worldFile, "World file (ini)")->required();
    auto* out = app.add_option("--out", m_out, "Folder for the results; replaced as a whole");
    app.add_option("--seed", m_seed, "Seed of all noise; same seed, same bytes")
        ->capture_default_str();
    app.add_option("--laps", m_laps, "Laps instead of the world file's")->check(CLI::Range(1, 100));
    app.add_option("--odometry-noise", m_odometryNoise, "low, medium or high")
        ->check(CLI::IsMember(namesOf(kNoise)));
    app.add_option("--camera", m_camera, "fixed:DEG, sweep or attend");
    app.add_option("--picture-size", m_pictureSize, "768x492 or 640x480")
        ->check(CLI::IsMember(namesOf(kSizes)));
    app.add_option("--threads", m_threads, "Threads that render; the result is the same")
        ->check(CLI::Range(1, 256))
        ->capture_default_str();
    auto* sightings = app.add_option(
        "--sightings", m_bankFile,
        "No pictures: what the front end sees is drawn from this bank, which is built if missing");
    app.add_option("--draws", m_draws, "Renderings of each picture in the bank")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str()
        ->needs(sightings);
    auto* print =
        app.add_flag("--print-config", m_printConfig, "Print the effective world and end");
    out->excludes(print);
    return runProgram(app, kExamples, argc, argv, [&] {
        if (m_printConfig)
            std::cout << simulator::asIni(effectiveWorld());
        else
            simulate();
    });
}

simulator::TWorld CSimApp::effectiveWorld() const {
    simulator::TWorld world = simulator::loadWorld(m_worldFile);
    if (m_laps) world.path.laps = *m_laps;
    if (!m_odometryNoise.empty()) world.odometry.level = kNoise.at(m_odometryNoise);
    if (!m_camera.empty()) world.head.mode = m_camera;
    if (!m_pictureSize.empty()) world.camera.size = kSizes.at(m_pictureSize);
    world.path.validate();
    world.head.validate();
    return world;
}

std::shared_ptr<const simulator::CSightingBank> CSimApp::bank(
    const simulator::TWorld& world) const {
    if (m_bankFile.empty()) return nullptr;
    simulator::TBankOptions options;
    options.draws = m_draws;
    options.threads = m_threads;
    const simulator::CBankBuilder builder(world, options);
    if (m_seed >= simulator::CBankBuilder::kFirstSeed)
        throw std::invalid_argument("--seed " + std::to_string(m_seed) + " is one of the bank's: " +
                                    std::to_string(simulator::CBankBuilder::kFirstSeed) +
                                    " and above");
    if (!std::filesystem::exists(m_bankFile)) {
        CProgressBar bar("bank", builder.pictureCount());
        simulator::CSightingBank::write(m_bankFile, builder.key(),
                                        builder.build([&bar] { bar.step(); }));
    }
    auto bank = std::make_shared<const simulator::CSightingBank>(m_bankFile);
    bank->requireKey(builder.key());
    return bank;
}

void CSimApp::simulate() const {
    if (m_out.empty())
        throw std::invalid_argument("--out is missing: name a folder for the results");
    cv::setNumThreads(1);  // the threads that render are ours
    const auto world = effectiveWorld();
    COutputFolder out(m_out);
    simulator::CSimulator simulator(world, {m_seed, m_threads, bank(world)});
    CProgressBar bar("rendering", m_bankFile.empty() ? simulator.pictureCount() : 0);
    const auto summary = simulator.run(out.path(), [&bar] { bar.step(); });
    out.publish();
    report(summary, m_out);
}

}  // namespace salma::apps
