// SPDX-License-Identifier: BSD-3-Clause
#include "CEvalApp.h"

#include <cmath>
#include <stdexcept>

#include "COutputFolder.h"
#include "addPositive.h"
#include "reports.h"
#include "runScore.h"

namespace salma::apps {
namespace {

using association::ELandmarkKind;

}  // namespace

CEvalApp::CEvalApp(CLI::App& app) : m_monteCarlo(app) {
    app.add_flag("--print-config", m_printConfig, "print the limits that would be used, and stop");
    app.require_subcommand(0, 1);
    addTrajectory(app);
    addAssociations(app);
    app.callback([this, &app] {
        if (!m_printConfig && app.get_subcommands().empty())
            throw CLI::RequiredError("A subcommand, trajectory, associations or montecarlo,");
    });
}

void CEvalApp::addTrajectory(CLI::App& app) {
    m_trajectory = app.add_subcommand(
        "trajectory", "absolute (ATE) and relative (RPE) error of a TUM trajectory in SE(2)");
    auto& command = *m_trajectory;
    command.add_option("REFERENCE", m_first, "TUM file of the true path")->required();
    command.add_option("ESTIMATE", m_second, "TUM file to score")->required();
    addPositive(command, "--max-gap-s", m_score.maxGap,
                "longest gap between two reference poses to interpolate over");
    addPositive(command, "--delta-m", m_score.deltaMetres, "distance that relative errors span");
    addPositive(command, "--delta-s", m_score.deltaSeconds, "time that relative errors span");
    addOutput(command);
}

void CEvalApp::addAssociations(CLI::App& app) {
    m_associations = app.add_subcommand(
        "associations", "precision, recall, wrong pairings and duplicates of a run");
    auto& command = *m_associations;
    command
        .add_option("TRUTH_DIR", m_first,
                    "folder with NAME.landmarks.csv, NAME.sightings.csv, NAME.gt.tum")
        ->required();
    command.add_option("RUN_DIR", m_second, "folder that salma-slam wrote")->required();
    command.add_option("--name", m_name, "NAME, where TRUTH_DIR holds several");
    addPositive(command, "--max-distance-px", m_matcher.maxPixels,
                "from the true centre in the picture to count as that landmark");
    addPositive(command, "--max-range-error-m", m_matcher.maxRange, "or from its true range and");
    addPositive(command, "--max-bearing-error-deg", m_maxBearingDegrees, "from its true bearing");
    addPositive(command, "--max-corner-error-m", m_matcher.maxCorner, "from a true corner");
    addOutput(command);
}

void CEvalApp::addOutput(CLI::App& command) {
    command.add_flag("--json", m_json, "print JSON instead of a table");
    command.add_option("--out", m_out, "folder to write the JSON to as well");
}

void CEvalApp::run(std::ostream& out) {
    m_matcher.maxBearing = m_maxBearingDegrees * M_PI / 180;
    if (m_printConfig)
        out << m_score.asIni("trajectory") << "\n" << m_matcher.asIni("associations");
    else if (m_trajectory->parsed())
        runTrajectory(out);
    else if (m_monteCarlo.isChosen())
        m_monteCarlo.run(out);
    else
        runAssociations(out);
}

void CEvalApp::runTrajectory(std::ostream& out) const {
    const auto reference = viz::readTum(m_first);
    const auto estimate = viz::readTum(m_second);
    const auto figures = viz::CTrajectoryScore(m_score).compare(reference, estimate);
    finish(out, "trajectory.json", trajectoryTable(figures, m_score),
           trajectoryJson(figures, m_score));
}

void CEvalApp::runAssociations(std::ostream& out) const {
    const TTruth truth = loadTruth(m_first, m_name);
    const auto rows =
        readAssociations((std::filesystem::path(m_second) / "associations.csv").string());
    const CTruthMatcher matcher(m_matcher, truth);
    auto figures = associationFigures(rows, truth, matcher);
    TAssociationReport report;
    report.truthName = truth.name;
    report.salient = figures[ELandmarkKind::salient];
    if (matcher.knowsCorners()) report.corners = figures[ELandmarkKind::corner];
    finish(out, "associations.json", associationTable(report), associationJson(report));
}

void CEvalApp::finish(std::ostream& out,
                      const std::string& name,
                      const std::string& table,
                      const std::string& json) const {
    if (!m_out.empty()) {
        COutputFolder folder(m_out);
        folder.write(name, json);
        folder.publishInto();
    }
    out << (m_json ? json : table);
}

}  // namespace salma::apps
