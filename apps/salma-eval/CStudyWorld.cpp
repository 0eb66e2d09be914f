// SPDX-License-Identifier: BSD-3-Clause
#include "CStudyWorld.h"

#include <salma/observations/CLogReader.h>
#include <salma/observations/CLogWriter.h>
#include <salma/simulator/CBankBuilder.h>
#include <salma/simulator/CSimulator.h>

#include <map>
#include <opencv2/core/utility.hpp>
#include <sstream>
#include <stdexcept>

#include "CChildPool.h"
#include "CPictureWork.h"
#include "CProgressBar.h"
#include "CResultFile.h"

namespace fs = std::filesystem;

namespace salma::apps {
namespace {

using observations::CObservationSalientLandmarks;
using simulator::EOdometryNoise;

const std::map<std::string, EOdometryNoise> kNoise = {{"low", EOdometryNoise::low},
                                                      {"medium", EOdometryNoise::medium},
                                                      {"high", EOdometryNoise::high}};

/// Hashes of the picture files that stand as textures in the world.
std::string textureHashes(const std::string& ini, const fs::path& folder) {
    std::istringstream lines(ini);
    std::string hashes;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string key, equals, value;
        if (!(words >> key >> equals >> value) || key != "texture") continue;
        if (fs::is_regular_file(folder / value)) hashes += md5OfFile(folder / value) + "\n";
    }
    return hashes;
}

observations::TSalientRecords recordsOf(const observations::TLog& log) {
    observations::TSalientRecords records;
    for (const auto& step : log.steps)
        for (const auto& o : step.observations)
            if (const auto record = std::dynamic_pointer_cast<CObservationSalientLandmarks>(o))
                records.push_back(record);
    return records;
}

}  // namespace

CStudyWorld::CStudyWorld(const fs::path& file, const TSlamConfig& config)
    : m_world(simulator::loadWorld(file)), m_config(config) {}

void CStudyWorld::useBank(const fs::path& folder, int draws, int threads) {
    const fs::path file = folder / (name() + ".bank");
    simulator::TBankOptions options;
    options.draws = draws;
    options.threads = threads;
    options.seeing = m_config.seeing;
    const simulator::CBankBuilder builder(m_world, options);
    if (!fs::exists(file)) {
        fs::create_directories(folder);
        CProgressBar bar("bank of " + name(), builder.pictureCount());
        TChildTask task;  // which has threads, as no process may that is copied later
        task.body = [&](const TChildTask::Tell& tell) {
            cv::setNumThreads(1);
            const auto views = builder.build([&] { tell("a picture"); });
            simulator::CSightingBank::write(file, builder.key(), views);
        };
        task.onLine = [&](const std::string&) { bar.step(); };
        const TChildEnd end = CChildPool::runOne(task);
        if (!end.failure.empty())
            throw std::runtime_error(file.string() + ": cannot be made: " + end.failure);
    }
    m_bank = std::make_shared<const simulator::CSightingBank>(file);
    m_bank->requireKey(builder.key());
    m_bankHash = md5OfFile(file);
}

std::string CStudyWorld::hash() const {
    auto world = m_world;
    world.odometry.level = EOdometryNoise::medium;  // a key of its own
    const std::string ini = simulator::asIni(world);
    return md5Of(ini + textureHashes(ini, world.file.parent_path()) + m_bankHash);
}

/// \return The rawlog.
fs::path CStudyWorld::simulate(std::uint32_t seed,
                               const std::string& noise,
                               const fs::path& folder,
                               bool pictures) const {
    cv::setNumThreads(1);
    fs::create_directories(folder);
    auto world = m_world;
    world.odometry.level = kNoise.at(noise);
    simulator::TSimulationOptions options;
    options.seed = seed;
    options.bank = m_bank;
    options.pictures = pictures;
    simulator::CSimulator(world, options).run(folder);
    return folder / (m_world.name() + ".rawlog");
}

void CStudyWorld::makeRecords(std::uint32_t seed, const fs::path& folder) const {
    if (m_bank) return;
    const auto log = observations::readLog(simulate(seed, "low", folder, true).string());
    auto config = m_config;
    config.run.threads = 1;
    const auto seen = CPictureWork(config, log).run();
    observations::saveCompanion(log, seen.records, observations::companionOf(log.file));
    fs::remove_all(log.imagesFolder);
}

void CStudyWorld::makeLog(std::uint32_t seed,
                          const std::string& noise,
                          const fs::path& records,
                          const fs::path& folder) const {
    const fs::path rawlog = simulate(seed, noise, folder, false);
    if (m_bank) return;
    const auto log = observations::readLog(rawlog.string());
    const auto seen = observations::readLog((records / rawlog.filename()).string());
    observations::saveCompanion(log, recordsOf(seen), observations::companionOf(log.file));
}

std::vector<std::string> noiseNames() { return {"low", "medium", "high"}; }

}  // namespace salma::apps
