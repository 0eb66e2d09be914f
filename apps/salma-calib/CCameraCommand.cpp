// SPDX-License-Identifier: BSD-3-Clause
#include "CCameraCommand.h"

#include <salma/config/CStrictFile.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "CHtmlPage.h"
#include "COutputFolder.h"
#include "cameraFiles.h"
#include "residualPlots.h"

namespace salma::apps {
namespace {

using calibration::TCameraCalibration;

constexpr auto kDescription = "Intrinsics and lens distortion from pictures of a flat board.";
constexpr auto kExamples =
    "Examples:\n"
    "  salma-calib camera left*.jpg --board 9x6 --square-m 0.025 --out out/camera\n"
    "  salma-calib camera a.png b.png c.png --pattern squares --board 8x8 --square-m 0.0127 "
    "--gap-m 0.00988 --out out/camera\n\n";
constexpr std::array<const char*, 9> kNames{"fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3"};

std::array<double, 9> valuesOf(const mrpt::img::TCamera& c) {
    return {c.fx(), c.fy(), c.cx(), c.cy(), c.k1(), c.k2(), c.p1(), c.p2(), c.k3()};
}

double sigmaOf(const TCameraCalibration& result, std::size_t i) {
    const auto k = static_cast<Eigen::Index>(i);
    return std::sqrt(result.covariance(k, k));
}

std::string stemOf(const std::string& file) { return std::filesystem::path(file).stem().string(); }

/// "0.263 px", or why there is no figure.
std::string heldOutText(const TCameraCalibration& result) {
    return result.heldOut.empty() ? "too few boards to leave any out"
                                  : fixed(TCameraCalibration::rmsOf(result.heldOut), 3) + " px";
}

std::string residualTable(const TSeenBoards& seen, const TCameraCalibration& result) {
    std::string text = "picture,point,u_px,v_px,du_px,dv_px,heldout_du_px,heldout_dv_px\n";
    for (std::size_t i = 0; i < seen.boards.size(); ++i)
        for (std::size_t k = 0; k < seen.boards[i].pixels.size(); ++k) {
            const auto& p = seen.boards[i].pixels[k];
            const auto& e = result.fitted[i].errors[k];
            text += stemOf(seen.boards[i].file) + "," + std::to_string(k) + "," + fixed(p.x, 3) +
                    "," + fixed(p.y, 3) + "," + fixed(e.x, 4) + "," + fixed(e.y, 4);
            if (result.heldOut.empty())
                text += ",,\n";
            else
                text += "," + fixed(result.heldOut[i].errors[k].x, 4) + "," +
                        fixed(result.heldOut[i].errors[k].y, 4) + "\n";
        }
    return text;
}

std::string asJson(const TSeenBoards& seen, const TCameraCalibration& result) {
    nlohmann::ordered_json json;
    const auto values = valuesOf(result.camera);
    for (std::size_t i = 0; i < values.size(); ++i)
        json["camera"][kNames[i]] = {{"value", values[i]}, {"sigma", sigmaOf(result, i)}};
    for (int r = 0; r < 9; ++r) {
        std::vector<double> row;
        for (int c = 0; c < 9; ++c) row.push_back(result.covariance(r, c));
        json["covariance"].push_back(row);
    }
    json["rms_px"] = TCameraCalibration::rmsOf(result.fitted);
    if (!result.heldOut.empty()) json["heldout_rms_px"] = TCameraCalibration::rmsOf(result.heldOut);
    for (std::size_t i = 0; i < seen.boards.size(); ++i) {
        nlohmann::ordered_json one{{"picture", seen.boards[i].file},
                                   {"rms_px", result.fitted[i].rms}};
        if (!result.heldOut.empty()) one["heldout_rms_px"] = result.heldOut[i].rms;
        json["pictures"].push_back(one);
    }
    json["without_board"] = seen.without;
    return json.dump(2) + "\n";
}

}  // namespace

CCameraCommand::CCameraCommand(CLI::App& app)
    : m_command(app.add_subcommand("camera", kDescription)) {
    m_board.addTo(*m_command);
    m_command->add_option("--out", m_out, "folder for the results");
    m_command->add_option("--config", m_configFile, "ini file: [camera_calibration]");
    m_command->add_flag("--print-config", m_printConfig, "print every key in use, and stop");
    // Examples belong to this command's own help, not to the list of commands.
    m_command->preparse_callback(
        [this](std::size_t) { m_command->description(std::string(kExamples) + kDescription); });
    m_command->callback([this] {
        if (m_printConfig) return;
        m_board.check();
        if (m_out.empty()) throw CLI::RequiredError("--out");
    });
}

void CCameraCommand::run(std::ostream& out) {
    if (!m_configFile.empty())
        m_options.loadFromConfigFile(*config::openStrict(m_configFile), "camera_calibration");
    if (m_printConfig) {
        out << m_options.asIni("camera_calibration");
        return;
    }
    COutputFolder folder(m_out);
    const TSeenBoards seen = m_board.find();
    std::vector<calibration::TBoardView> views;
    for (const auto& board : seen.boards) views.push_back({board.file, board.pixels});
    const auto result = calibration::CCameraCalibrator(m_options).calibrate(m_board.board.points(),
                                                                            views, seen.size);
    writeResults(folder, seen, result);
    writeReport(folder, seen, result);
    folder.publish();
    const auto values = valuesOf(result.camera);
    out << seen.boards.size() << " of " << m_board.images.size() << " pictures show the board\n";
    for (std::size_t i = 0; i < values.size(); ++i)
        out << kNames[i] << " " << fixed(values[i], i < 4 ? 2 : 5) << " +- "
            << fixed(sigmaOf(result, i), i < 4 ? 2 : 5) << "\n";
    out << "reprojection error " << fixed(TCameraCalibration::rmsOf(result.fitted), 3)
        << " px fitted, held out " << heldOutText(result) << "\n"
        << "report " << m_out << "/report.html\n";
}

void CCameraCommand::writeResults(const COutputFolder& folder,
                                  const TSeenBoards& seen,
                                  const TCameraCalibration& result) const {
    writeFile(folder / "camera.ini", cameraSection(result.camera));
    writeFile(folder / "camera.yaml", cameraYaml(result.camera, "camera"));
    writeFile(folder / "calibration.json", asJson(seen, result));
    writeFile(folder / "residuals.csv", residualTable(seen, result));
    TResidualPlot plot;
    plot.size = seen.size;
    for (std::size_t i = 0; i < seen.boards.size(); ++i)
        for (std::size_t k = 0; k < seen.boards[i].pixels.size(); ++k) {
            plot.places.push_back(seen.boards[i].pixels[k]);
            plot.fitted.push_back(result.fitted[i].errors[k]);
            if (!result.heldOut.empty()) plot.heldOut.push_back(result.heldOut[i].errors[k]);
        }
    plotResiduals(plot, folder / "residuals.png");
}

void CCameraCommand::writeReport(const COutputFolder& folder,
                                 const TSeenBoards& seen,
                                 const TCameraCalibration& result) const {
    CHtmlPage page("Camera calibration");
    const auto values = valuesOf(result.camera);
    std::vector<CHtmlPage::TRow> rows{{"", "value", "sigma"}};
    for (std::size_t i = 0; i < values.size(); ++i)
        rows.push_back(
            {kNames[i], fixed(values[i], i < 4 ? 2 : 5), fixed(sigmaOf(result, i), i < 4 ? 2 : 5)});
    page.table(rows);
    page.paragraph("fx, fy, cx, cy in pixels, of pictures of " + std::to_string(seen.size.width) +
                   " x " + std::to_string(seen.size.height) +
                   ". Sigmas take errors of points for independent.");
    page.heading("Residuals");
    page.paragraph("Reprojection error (root of the mean squared distance) " +
                   fixed(TCameraCalibration::rmsOf(result.fitted), 3) +
                   " px for all boards in the fit; of boards left out of it, " +
                   heldOutText(result) + ".");
    page.picture(
        folder / "residuals.png",
        "Left: seen minus expected place of each point. Right: the same where it was seen, "
        "enlarged.");
    rows = {{"picture", "fitted RMS [px]", "held out RMS [px]"}};
    for (std::size_t i = 0; i < seen.boards.size(); ++i)
        rows.push_back({seen.boards[i].file, fixed(result.fitted[i].rms, 3),
                        result.heldOut.empty() ? "-" : fixed(result.heldOut[i].rms, 3)});
    for (const auto& file : seen.without) rows.push_back({file, "no board", "-"});
    page.table(rows);
    page.paragraph(
        "Held out: the boards are cut into " + std::to_string(m_options.folds) +
        " blocks of neighbours; each block is left out once, and its boards are located with the "
        "camera that the others give.");
    writeFile(folder / "report.html", page.html());
}

}  // namespace salma::apps
