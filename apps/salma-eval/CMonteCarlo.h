// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <TSlamConfig.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "CChildPool.h"
#include "CResultFile.h"
#include "CStudyWorld.h"
#include "TRunScore.h"

namespace salma::apps {

/// What is run: all combinations.
struct TStudy {
    std::string config;               //!< An ini file of salma-slam.
    std::vector<std::string> worlds;  //!< World files, with different names.
    std::string banks;                //!< Folder of their banks of sightings; "": render.
    int draws{4};                     //!< Renderings of each picture in a bank.
    std::vector<std::string> noise;   //!< As noiseNames() has them; so below.
    std::vector<std::string> backends, methods;
    std::uint32_t firstSeed{1}, seeds{50};
    std::size_t jobs{1};           //!< Processes that work at one time.
    double limit{600};             //!< Processor time of a run or of making a log [s].
    bool retryFailed{false};       //!< Runs that failed before are made again.
    std::filesystem::path folder;  //!< Where logs are kept while they are needed.
};

/** Runs association methods and back ends on many simulated logs.
 *
 * A (world, seed) is a job: for each level of noise its log is made once and read once, then each
 * run is a process of its own (CChildPool), as are making and reading. What crashes, hangs or
 * throws is a failed run, never the end of the study. The results do not depend on the number of
 * jobs. */
class CMonteCarlo {
 public:
    /// Reads configuration and worlds. \throw std::exception naming file, section, key and value
    explicit CMonteCarlo(const TStudy& study);
    CMonteCarlo(const CMonteCarlo&) = delete;
    CMonteCarlo& operator=(const CMonteCarlo&) = delete;

    /// Makes the banks that are missing; call it before all else. \throw std::exception
    void prepare();

    /** Makes the runs that `file` has no result of.
     * \param onRun Called for each run made. */
    void run(CResultFile& file, const std::function<void()>& onRun) const;

    /// Runs that run() would make.
    std::size_t pending(const CResultFile& file) const;

    /// The results of this study's runs, in its order: world, noise, back end, method, seed.
    std::vector<TRunResult> results(const CResultFile& file) const;

    /// Results of runs of these names on another world or configuration; results() leaves them out.
    std::size_t outdated(const CResultFile& file) const;

 private:
    /// Runs on the logs of one (world, seed), in the order of noise.
    struct TJob {
        std::size_t world{0};
        std::uint32_t seed{0};
        std::vector<TRunKey> runs;
    };

    TRunKey key(std::size_t world, const std::string& noise, std::uint32_t seed) const;
    /// Calls action(index of the world, key) for each run, in the order of the study.
    template <class ACTION>
    void forEachRun(const ACTION& action) const;
    std::vector<TJob> jobs(const CResultFile& file) const;
    std::filesystem::path folderOf(const TJob& job) const;
    TChildEnd apart(const std::function<void()>& body) const;
    void work(const TJob& job, const TChildTask::Tell& tell) const;
    void replay(const std::filesystem::path& rawlog,
                const std::vector<TRunKey>& runs,
                int laps,
                const TChildTask::Tell& tell) const;
    TRunResult failed(const TRunKey& run, const std::string& failure) const;
    double wallLimit() const;

    TStudy m_study;
    TSlamConfig m_config;
    std::vector<CStudyWorld> m_worlds;
    std::vector<std::string> m_worldHashes;
    std::string m_configHash, m_program;
};

}  // namespace salma::apps
