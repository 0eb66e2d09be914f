// SPDX-License-Identifier: BSD-3-Clause
#include "CCalibrateCommand.h"

#include <COutputFolder.h>
#include <TSlamConfig.h>
#include <salma/observations/registerClasses.h>

#include <fstream>
#include <opencv2/core/utility.hpp>
#include <stdexcept>

#include "CCalibration.h"
#include "calibrationFiles.h"

namespace salma::apps {
namespace {

constexpr auto kDescription =
    "Learns log p(score|same) / p(score|other) from simulated runs, and tries it on others.";
constexpr auto kExamples =
    "Examples:\n"
    "  salma-landmarks calibrate out/learn-1 out/learn-2 --out out/calibration\n"
    "  salma-landmarks calibrate out/learn-1 --report out/report-1 --out out/calibration\n\n";

void writeFile(const std::filesystem::path& file, const std::string& text) {
    std::ofstream out(file, std::ios::binary);
    out << text;
    out.close();
    if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace

CCalibrateCommand::CCalibrateCommand(CLI::App& app)
    : m_command(app.add_subcommand("calibrate", kDescription)) {
    m_command->add_option("TRUTH_DIR", m_learning, "folders of salma-sim to learn from");
    m_command->add_option("--report", m_report,
                          "folders with other pictures, to try what was learned");
    m_command->add_option("--config", m_configFile, "ini file of salma-slam: seeing, matching");
    m_command->add_option("--out", m_out, "folder for tables, figures and calibration.ini");
    m_command->add_flag("--print-config", m_printConfig, "print every option in use, and stop");
    // Examples belong to this command's own help, not to the list of commands.
    m_command->preparse_callback(
        [this](std::size_t) { m_command->description(std::string(kExamples) + kDescription); });
    addOptions();
}

void CCalibrateCommand::addOptions() {
    m_command->add_option("--bins", m_options.bins, "of the score")->capture_default_str();
    m_command
        ->add_option("--prior-count", m_options.priorCount,
                     "sightings of each kind that the bins begin with, spread evenly")
        ->capture_default_str();
    m_command
        ->add_option("--per-poster", m_options.perPoster,
                     "independent sightings that a poster, or a pair of posters, is worth")
        ->capture_default_str();
    m_command
        ->add_option("--spoilt-rate", m_options.spoiltRate,
                     "share of real views that are spoilt, by glare or people in front")
        ->capture_default_str();
    m_command
        ->add_option("--track-gap-s", m_options.trackGap,
                     "a poster not seen for longer begins another track")
        ->capture_default_str();
}

void CCalibrateCommand::run(std::ostream& out) {
    m_options.validate();
    const TSlamConfig config =
        m_configFile.empty() ? TSlamConfig() : TSlamConfig::load(m_configFile);
    if (m_printConfig) {
        out << m_options.asIni("calibrate") << "\n" << config.asIni();
        return;
    }
    if (m_learning.empty()) throw CLI::RequiredError("TRUTH_DIR");
    if (m_out.empty()) throw CLI::RequiredError("--out");
    observations::registerClasses();
    cv::setNumThreads(1);         // the threads are ours
    COutputFolder folder(m_out);  // a bad place is found before the work
    const TCalibration calibration = CCalibration(m_options, config).run(m_learning, m_report);
    writeFile(folder / "calibration.ini", calibrationIni(calibration));
    writeFile(folder / "calibration.json", calibrationJson(calibration));
    writeFile(folder / "bins.csv", binsCsv(calibration));
    writeFile(folder / "pairs.csv", pairsCsv(calibration));
    writeFile(folder / "reliability.csv", reliabilityCsv(calibration));
    writeFile(folder / "decorrelation.csv", decorrelationCsv(calibration));
    writeFile(folder / "detection.csv", detectionCsv(calibration));
    plotTables(calibration, (folder / "tables.png").string());
    plotReliability(calibration, (folder / "reliability.png").string());
    folder.publish();
    out << calibrationTable(calibration) << "written to " << m_out << "\n";
}

}  // namespace salma::apps
