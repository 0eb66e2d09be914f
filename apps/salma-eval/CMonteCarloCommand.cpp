// SPDX-License-Identifier: BSD-3-Clause
#include "CMonteCarloCommand.h"

#include <sys/resource.h>

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <map>
#include <set>
#include <thread>

#include "COutputFolder.h"
#include "CProgressBar.h"
#include "addPositive.h"
#include "backend.h"
#include "studyFiles.h"

namespace fs = std::filesystem;

namespace salma::apps {
namespace {

constexpr auto kDescription =
    "many simulated runs: success, association and consistency of each method";
constexpr auto kExamples =
    "Examples:\n"
    "  salma-eval montecarlo config.ini --worlds share/worlds/hallway-loop.ini --seeds 10 "
    "--out out/study\n"
    "  salma-eval montecarlo config.ini --worlds a.ini,b.ini --methods nn,saliency --noise high "
    "--out out/study\n\n";

CLI::Option* addNames(CLI::App& command,
                      const std::string& flag,
                      std::vector<std::string>& names,
                      const std::vector<std::string>& known) {
    std::string all;
    for (const auto& name : known) all += (all.empty() ? "" : ",") + name;
    return command.add_option(flag, names, "of " + all)
        ->delimiter(',')
        ->check(CLI::IsMember(known));
}

/// Each name once: twice would count its runs twice.
void rejectTwice(const std::string& flag, const std::vector<std::string>& names) {
    std::set<std::string> known;
    for (const auto& name : names)
        if (!known.insert(name).second) throw CLI::ValidationError(flag, name + " is named twice");
}

/// Of this process and of its children that have ended [s].
double cpuSeconds() {
    double seconds = 0;
    for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage usage{};
        getrusage(who, &usage);
        for (const auto& time : {usage.ru_utime, usage.ru_stime})
            seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    }
    return seconds;
}

/// How many failed of each kind of failure, most first told to the user.
void noticeFailures(const std::vector<TRunResult>& results) {
    std::map<std::string, std::size_t> counts;
    for (const auto& result : results)
        if (result.failed()) ++counts[result.failure];
    for (const auto& [failure, count] : counts)
        std::cerr << "notice: " << count << " of " << results.size() << " runs failed: " << failure
                  << "\n";
}

void noticePrograms(const std::vector<TRunResult>& results) {
    std::set<std::string> programs;
    for (const auto& result : results) programs.insert(result.program);
    if (programs.size() > 1)
        std::cerr << "notice: the results come from " << programs.size()
                  << " different builds of this program\n";
}

void printSuccess(std::ostream& out, const std::vector<TStudyRow>& rows) {
    out << std::left << std::setw(16) << "world" << std::setw(8) << "noise" << std::setw(6) << ""
        << std::setw(10) << "method" << std::right << std::setw(6) << "runs" << std::setw(8)
        << "failed" << std::setw(9) << "success" << std::setw(12) << "wrong loop" << std::setw(12)
        << "precision" << std::setw(9) << "recall" << std::setw(18) << "last-lap ATE [m]"
        << std::setw(10) << "ms/step"
        << "\n"
        << std::fixed;
    for (const auto& row : rows)
        out << std::left << std::setw(16) << row.world << std::setw(8) << row.noise << std::setw(6)
            << row.backend << std::setw(10) << row.method << std::right << std::setw(6) << row.runs
            << std::setw(8) << row.failed << std::setw(9) << row.success.count << std::setw(12)
            << row.wrongLoop.count << std::setprecision(2) << std::setw(10)
            << 100 * row.precision.share() << " %" << std::setw(7) << 100 * row.recall.share()
            << " %" << std::setprecision(3) << std::setw(18) << row.medianAteLastLap
            << std::setprecision(2) << std::setw(10) << 1000 * row.cpuPerStep << "\n";
}

}  // namespace

CMonteCarloCommand::CMonteCarloCommand(CLI::App& app)
    : m_command(app.add_subcommand("montecarlo", kDescription)) {
    m_study.noise = noiseNames();
    m_study.backends = {"ekf"};
    m_study.methods = methodNames();
    m_study.jobs = std::max(1U, std::thread::hardware_concurrency());
    // Examples belong to this command's own help, not to the list of commands.
    m_command->preparse_callback(
        [this](std::size_t) { m_command->description(std::string(kExamples) + kDescription); });
    addOptions();
}

void CMonteCarloCommand::addOptions() {
    auto& command = *m_command;
    command.add_option("CONFIG", m_study.config, "ini file of salma-slam")->required();
    command.add_option("--worlds", m_study.worlds, "world files of salma-sim, with commas between")
        ->delimiter(',')
        ->required();
    auto* banks = command.add_option(
        "--banks", m_study.banks,
        "take sightings from the banks in this folder, which are made if missing; "
        "else the pictures of each drive are rendered");
    command.add_option("--draws", m_study.draws, "renderings of each picture in a bank")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str()
        ->needs(banks);
    addNames(command, "--noise", m_study.noise, noiseNames())->capture_default_str();
    addNames(command, "--backends", m_study.backends, backendNames())->capture_default_str();
    addNames(command, "--methods", m_study.methods, methodNames())->capture_default_str();
    command.add_option("--seeds", m_study.seeds, "drives in each world")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    command.add_option("--first-seed", m_study.firstSeed, "of these drives")
        ->check(CLI::Range(0, 900000))
        ->capture_default_str();
    command.add_option("--jobs", m_study.jobs, "processes that work at one time")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    command.add_option("--out", m_out, "folder for results and tables; what it has is not redone")
        ->required();
    addPositive(command, "--limit-s", m_study.limit,
                "processor time of a run, and of making a log, before it counts as failed");
    command.add_flag("--retry-failed", m_study.retryFailed, "make runs again that failed before");
    addPositive(command, "--max-ate-m", m_limits.maxAte, "over the last lap, for success");
    addPositive(command, "--door-spacing-m", m_limits.doorSpacing,
                "a robot that ends off by more than half of it is lost");
}

void CMonteCarloCommand::run(std::ostream& out) {
    rejectTwice("--noise", m_study.noise);
    rejectTwice("--backends", m_study.backends);
    rejectTwice("--methods", m_study.methods);
    const fs::path folder(m_out);
    m_study.folder = folder / "logs";
    CMonteCarlo study(m_study);
    COutputFolder(folder).publishInto();  // a bad place is found before the work
    study.prepare();
    CResultFile file(folder / "results.jsonl");
    if (const std::size_t outdated = study.outdated(file); outdated > 0)
        std::cerr << "notice: " << outdated
                  << " results there are of another configuration or world and are not used\n";
    const std::size_t pending = study.pending(file);
    {
        CProgressBar bar("runs", pending);
        study.run(file, [&bar] { bar.step(); });
    }
    const auto results = study.results(file);
    noticeFailures(results);
    noticePrograms(results);
    write(results);
    printSuccess(out, studyTable(results, m_limits));
    double inRuns = 0;
    for (const auto& result : results) inRuns += result.cpuSeconds;
    out << pending << " runs made, " << results.size() - pending << " were there; " << std::fixed
        << std::setprecision(1) << cpuSeconds() << " s of processor time now, " << inRuns
        << " s in all runs of the table\n"
        << "table " << (folder / "table.md").string() << "\n";
}

void CMonteCarloCommand::write(const std::vector<TRunResult>& results) const {
    const auto rows = studyTable(results, m_limits);
    COutputFolder files(m_out);
    files.write("table.csv", studyCsv(rows));
    files.write("table.json", studyJson(rows, m_limits));
    files.write("table.md", studyMarkdown(rows, m_limits));
    files.write("runs.csv", runsCsv(results, m_limits));
    files.write("times.csv", timesCsv(results));
    plotSuccess(rows, (files / "success.png").string());
    plotErrors(rows, m_limits, (files / "errors.png").string());
    plotConsistency(rows, (files / "consistency.png").string());
    files.publishInto();
}

}  // namespace salma::apps
