// SPDX-License-Identifier: BSD-3-Clause
#include "CGrabApp.h"

#include <mrpt/core/format.h>
#include <mrpt/system/datetime.h>
#include <mrpt/system/os.h>
#include <salma/config/CStrictFile.h>
#include <salma/drivers/registerSensors.h>
#include <salma/observations/CLogReader.h>
#include <salma/observations/registerClasses.h>
#include <salma/observations/repairLog.h>
#include <salma/sensing/registerSensors.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "CCapture.h"

namespace salma::apps {
namespace {

/// As rawlog-grabber names it: by the time, as the clock on the wall shows it.
std::string nameByTime(const std::string& prefix) {
    mrpt::system::TTimeParts t;
    mrpt::system::timestampToParts(mrpt::Clock::now(), t, true);
    return prefix + mrpt::format("_%04u-%02u-%02u_%02uh%02um%02us.rawlog", unsigned{t.year},
                                 unsigned{t.month}, unsigned{t.day}, unsigned{t.hour},
                                 unsigned{t.minute}, static_cast<unsigned>(t.second));
}

/// Several lines as one.
std::string joined(std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

std::string lossOf(const observations::TRepair& repair) {
    std::string text =
        mrpt::format("%llu bytes", static_cast<unsigned long long>(repair.bytesLost));
    if (repair.packedBytesLost > 0)
        text += mrpt::format(" and %llu more that cannot be unpacked",
                             static_cast<unsigned long long>(repair.packedBytesLost));
    return text;
}

}  // namespace

CGrabApp::CGrabApp(CLI::App& app) {
    app.add_option("CONFIG", m_config, "ini file of rawlog-grabber");
    app.add_option("--out", m_out,
                   "X.rawlog; the default is named by [global] rawlog_prefix and time");
    app.add_option("--duration", m_duration, "seconds; without it until Ctrl-C or SIGTERM")
        ->check(CLI::PositiveNumber);
    app.add_option("-p,--plugins", m_plugins,
                   "libraries with further sensors, a comma between two");
    app.add_flag("--embed", m_embed, "all records into X.rawlog, none into X.salient.rawlog");
    app.add_flag("--overwrite", m_overwrite, "replace a log that exists");
    app.add_option("--repair", m_repair, "keep what is whole of a log that breaks off");
    app.add_flag("--print-config", m_printConfig, "print the options in effect, and stop");
    app.callback([this] {
        if (m_repair.empty() && m_config.empty() && !m_printConfig)
            throw CLI::RequiredError("CONFIG, or --repair FILE,");
        if (!m_repair.empty() && !m_config.empty())
            throw CLI::ValidationError("CONFIG and --repair exclude each other");
    });
}

void CGrabApp::loadPlugins() const {
    if (m_plugins.empty()) return;
    std::string problem;
    if (!mrpt::system::loadPluginModules(m_plugins, problem))
        throw std::runtime_error("--plugins: " + joined(problem));
}

std::unique_ptr<mrpt::config::CConfigFile> CGrabApp::openConfig() const {
    return m_config.empty() ? nullptr : config::openStrict(m_config);
}

void CGrabApp::run(std::ostream& out) {
    if (m_printConfig) return printConfig(out);
    loadPlugins();  // first: what a plug-in brings along is not registered again
    observations::registerClasses();
    drivers::registerSensors();
    sensing::registerSensors();
    if (m_repair.empty())
        capture(out);
    else
        repair(out);
}

void CGrabApp::printConfig(std::ostream& out) const {
    TGlobalOptions global;
    TGrabOptions grab;
    if (const auto file = openConfig()) {
        global.loadFromConfigFile(*file, "global");
        grab.loadFromConfigFile(*file, "salma-grab");
    }
    out << global.asIni("global") << "\n" << grab.asIni("salma-grab");
}

void CGrabApp::capture(std::ostream& out) {
    const auto file = openConfig();
    CCapture::TSettings settings;
    settings.global.loadFromConfigFile(*file, "global");
    settings.grab.loadFromConfigFile(*file, "salma-grab");
    settings.log = m_out.empty() ? nameByTime(settings.global.prefix) : m_out;
    if (std::filesystem::path(settings.log).extension() != ".rawlog")
        throw std::invalid_argument("--out " + settings.log + ": the name must end in .rawlog");
    settings.embed = m_embed;
    settings.overwrite = m_overwrite;
    settings.duration = m_duration;
    CCapture(*file, settings).run(m_signals, out);
}

void CGrabApp::repair(std::ostream& out) const {
    repairOne(m_repair, m_out.empty() ? m_repair : m_out, out);
    const std::string companion = observations::companionOf(m_repair);
    if (m_out.empty() && std::filesystem::exists(companion)) repairOne(companion, companion, out);
}

void CGrabApp::repairOne(const std::string& file,
                         const std::string& target,
                         std::ostream& out) const {
    const auto result = observations::repairLog(file, target);
    const std::string kept = mrpt::format(
        "%zu records, %llu bytes, last good time %s (%.6f s)", result.records,
        static_cast<unsigned long long>(result.bytesKept),
        mrpt::system::dateTimeLocalToString(mrpt::Clock::fromDouble(result.lastGoodTime)).c_str(),
        result.lastGoodTime);
    if (result.whole) {
        out << file << ": is whole: " << kept << "\n";
        return;
    }
    out << file << ": " << result.cause << "\n  kept " << kept << "\n  lost " << lossOf(result)
        << "; "
        << (result.secondsLost
                ? mrpt::format("%.2f s passed from the last good time to the last write",
                               *result.secondsLost)
                : std::string("the file's date does not tell how many seconds"))
        << "\n  written to " << target
        << (target == file ? ", the broken one is kept as " + file + ".broken" : "") << "\n";
}

}  // namespace salma::apps
