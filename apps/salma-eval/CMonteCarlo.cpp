// SPDX-License-Identifier: BSD-3-Clause
#include "CMonteCarlo.h"

#include <salma/observations/CLogReader.h>
#include <salma/observations/registerClasses.h>

#include <algorithm>
#include <ctime>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>

#include "CMapping.h"
#include "backend.h"
#include "runScore.h"

namespace fs = std::filesystem;

namespace salma::apps {
namespace {

/// A text that only equal keys share; without what the run was made from if `hashes` is false.
std::string textOf(const TRunKey& key, bool hashes = true) {
    std::string text = key.world + "/" + key.noise + "/" + std::to_string(key.seed) + "/" +
                       key.backend + "/" + key.method;
    return hashes ? text + "/" + key.worldHash + "/" + key.configHash : text;
}

/// The last result of each key.
std::map<std::string, const TRunResult*> byKey(const CResultFile& file) {
    std::map<std::string, const TRunResult*> found;
    for (const auto& result : file.results()) found[textOf(result.key)] = &result;
    return found;
}

std::string configHashOf(TSlamConfig config) {
    config.run.threads = 0;  // neither changes a result
    config.run.rawlog.clear();
    setBackend(backendNames().front(), config);  // keys of their own
    setMethod(methodNames().front(), config);
    return md5Of(config.asIni());
}

/// Processor time of this process [s].
double processorTime() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// What salma-slam does with a log that holds the front end's records, and its score.
void mapAndScore(TSlamConfig config,
                 const observations::TLog& log,
                 const TTruth& truth,
                 int laps,
                 TRunResult& result) {
    setBackend(result.key.backend, config);
    setMethod(result.key.method, config);
    setSeed(static_cast<int>(result.key.seed), config);
    const double start = processorTime();
    const auto backend = createBackend(config);
    slam::TRunRecord record;
    CMapping(config, log, *backend).run({}, record);
    result.mappingSeconds = processorTime() - start;
    if (record.trajectory.empty())
        throw std::runtime_error(log.file + ": nothing in it could be used for a step");
    result.score = scoreRun(record, truth, laps);
    result.cpuSeconds = processorTime() - start;
}

}  // namespace

CMonteCarlo::CMonteCarlo(const TStudy& study)
    : m_study(study),
      m_config(TSlamConfig::load(study.config)),
      m_configHash(configHashOf(m_config)),
      m_program(md5OfFile("/proc/self/exe")) {
    observations::registerClasses();
    std::map<std::string, std::string> names;
    for (const auto& file : study.worlds) {
        m_worlds.emplace_back(file, m_config);
        const auto [other, isNew] = names.emplace(m_worlds.back().name(), file);
        if (!isNew)
            throw std::invalid_argument(other->second + " and " + file +
                                        ": results of both would be named " + other->first);
    }
}

void CMonteCarlo::prepare() {
    for (auto& world : m_worlds) {
        if (!m_study.banks.empty())
            world.useBank(m_study.banks, m_study.draws, static_cast<int>(m_study.jobs));
        m_worldHashes.push_back(world.hash());
    }
}

TRunKey CMonteCarlo::key(std::size_t world, const std::string& noise, std::uint32_t seed) const {
    TRunKey key;
    key.world = m_worlds[world].name();
    key.worldHash = m_worldHashes[world];
    key.noise = noise;
    key.seed = seed;
    key.configHash = m_configHash;
    return key;
}

template <class ACTION>
void CMonteCarlo::forEachRun(const ACTION& action) const {
    for (std::size_t world = 0; world < m_worlds.size(); ++world)
        for (const auto& noise : m_study.noise)
            for (const auto& backend : m_study.backends)
                for (const auto& method : m_study.methods)
                    for (std::uint32_t i = 0; i < m_study.seeds; ++i) {
                        TRunKey run = key(world, noise, m_study.firstSeed + i);
                        run.backend = backend;
                        run.method = method;
                        action(world, run);
                    }
}

std::vector<CMonteCarlo::TJob> CMonteCarlo::jobs(const CResultFile& file) const {
    const auto made = byKey(file);
    std::map<std::pair<std::uint32_t, std::size_t>, TJob> jobs;  // all worlds of a seed first
    forEachRun([&](std::size_t world, const TRunKey& run) {
        const auto found = made.find(textOf(run));
        const bool isMade =
            found != made.end() && !(m_study.retryFailed && found->second->failed());
        if (isMade) return;
        TJob& job = jobs[{run.seed, world}];
        job.world = world;
        job.seed = run.seed;
        job.runs.push_back(run);
    });
    std::vector<TJob> result;
    for (auto& entry : jobs) result.push_back(std::move(entry.second));
    return result;
}

std::size_t CMonteCarlo::pending(const CResultFile& file) const {
    std::size_t count = 0;
    for (const auto& job : jobs(file)) count += job.runs.size();
    return count;
}

std::size_t CMonteCarlo::outdated(const CResultFile& file) const {
    std::set<std::string> keys, names;
    forEachRun([&](std::size_t, const TRunKey& run) {
        keys.insert(textOf(run));
        names.insert(textOf(run, false));
    });
    return static_cast<std::size_t>(
        std::count_if(file.results().begin(), file.results().end(), [&](const auto& result) {
            return names.count(textOf(result.key, false)) != 0 &&
                   keys.count(textOf(result.key)) == 0;
        }));
}

std::vector<TRunResult> CMonteCarlo::results(const CResultFile& file) const {
    const auto made = byKey(file);
    std::vector<TRunResult> results;
    forEachRun([&](std::size_t, const TRunKey& run) {
        const auto found = made.find(textOf(run));
        if (found != made.end()) results.push_back(*found->second);
    });
    return results;
}

TRunResult CMonteCarlo::failed(const TRunKey& run, const std::string& failure) const {
    TRunResult result;
    result.key = run;
    result.program = m_program;
    result.failure = failure;
    return result;
}

/// A run may wait for a processor, or for a disk; it is given up if it does little else.
double CMonteCarlo::wallLimit() const { return 20 * m_study.limit + 5; }

fs::path CMonteCarlo::folderOf(const TJob& job) const {
    return m_study.folder / (m_worlds[job.world].name() + "-" + std::to_string(job.seed));
}

void CMonteCarlo::run(CResultFile& file, const std::function<void()>& onRun) const {
    const auto jobs = this->jobs(file);
    fs::remove_all(m_study.folder);  // of a study that was killed
    CChildPool(m_study.jobs).run(jobs.size(), [&](std::size_t i) {
        const TJob& job = jobs[i];
        auto left = std::make_shared<std::map<std::string, TRunKey>>();
        for (const auto& run : job.runs) left->emplace(textOf(run), run);
        const auto keep = [&file, &onRun, left](const TRunResult& result) {
            left->erase(textOf(result.key));
            file.add(result);
            onRun();
        };
        TChildTask task;
        task.body = [this, &job](const TChildTask::Tell& tell) { work(job, tell); };
        task.onLine = [keep](const std::string& line) { keep(resultOf(line)); };
        task.onEnd = [this, &job, keep, left](const TChildEnd& end) {
            fs::remove_all(folderOf(job));
            const auto lost = *left;
            for (const auto& entry : lost)
                keep(failed(entry.second, "its log could not be read: " + end.failure));
        };
        task.wallLimit = wallLimit() * static_cast<double>(2 * job.runs.size() + 1);
        return task;
    });
    fs::remove_all(m_study.folder);
}

/// Does `body` in a child process, so that what it leaves in memory is gone after it.
TChildEnd CMonteCarlo::apart(const std::function<void()>& body) const {
    TChildTask task;
    task.body = [&](const TChildTask::Tell&) { body(); };
    task.cpuLimit = m_study.limit;
    task.wallLimit = wallLimit();
    return CChildPool::runOne(task);
}

/// Runs in a child process: all runs on the logs of one (world, seed).
void CMonteCarlo::work(const TJob& job, const TChildTask::Tell& tell) const {
    const CStudyWorld& world = m_worlds[job.world];
    const fs::path records = folderOf(job) / "records";
    const TChildEnd seen = apart([&] { world.makeRecords(job.seed, records); });
    std::map<std::string, std::vector<TRunKey>> byNoise;
    for (const auto& run : job.runs) byNoise[run.noise].push_back(run);
    for (const auto& [noise, runs] : byNoise) {
        const fs::path folder = folderOf(job) / noise;
        TChildEnd end = seen;
        if (end.failure.empty())
            end = apart([&, &level = noise] { world.makeLog(job.seed, level, records, folder); });
        if (end.failure.empty())
            replay(folder / (world.name() + ".rawlog"), runs, world.laps(), tell);
        else
            for (const auto& run : runs)
                tell(asLine(failed(run, "its log could not be made: " + end.failure)));
        fs::remove_all(folder);
    }
}

void CMonteCarlo::replay(const fs::path& rawlog,
                         const std::vector<TRunKey>& runs,
                         int laps,
                         const TChildTask::Tell& tell) const {
    const auto log = observations::readLog(rawlog.string());
    const auto truth = loadTruth(rawlog.parent_path(), rawlog.stem().string());
    for (const auto& run : runs) {
        TChildTask task;
        bool told = false;
        task.body = [&](const TChildTask::Tell& tellHere) {
            TRunResult result = failed(run, "");
            mapAndScore(m_config, log, truth, laps, result);
            tellHere(asLine(result));
        };
        task.onLine = [&](const std::string& line) {
            told = true;
            tell(line);
        };
        task.cpuLimit = m_study.limit;
        task.wallLimit = wallLimit();
        const TChildEnd end = CChildPool::runOne(task);
        if (!told) tell(asLine(failed(run, end.failure)));
    }
}

}  // namespace salma::apps
