// SPDX-License-Identifier: BSD-3-Clause
#include "CLaserCameraCommand.h"

#include <mrpt/core/bits_math.h>
#include <salma/config/CStrictFile.h>
#include <salma/observations/readCamera.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "CHtmlPage.h"
#include "COutputFolder.h"
#include "cameraFiles.h"
#include "laserOverlay.h"
#include "residualPlots.h"

namespace salma::apps {
namespace {

using calibration::TLaserCameraCalibration;
using mrpt::poses::CPose3D;

constexpr auto kDescription =
    "The camera's pose beside a 2-D laser, from pictures of a board and scans of it.";
constexpr auto kExamples =
    "Examples:\n"
    "  salma-calib laser-camera *.png --scans scans.txt --camera out/camera/camera.ini --board 9x6 "
    "--square-m 0.09 --out out/laser-camera\n"
    "  salma-calib laser-camera *.png --scans scans.txt --first-scan 31 --camera camera.ini "
    "--board "
    "9x6 --square-m 0.09 --laser-pose-m-deg 0.2 0 0.35 0 0 0 --label CAMERA1 --out out/mounted\n\n";
constexpr std::array<const char*, 7> kNames{"x", "y", "z", "yaw", "pitch", "roll", "offset"};

/// x, y, z [mm], yaw, pitch, roll [deg] of T_l_c and offset [mm].
std::array<double, 7> valuesOf(const TLaserCameraCalibration& r) {
    using mrpt::RAD2DEG;
    return {1e3 * r.T_l_c.x(),      1e3 * r.T_l_c.y(),        1e3 * r.T_l_c.z(),
            RAD2DEG(r.T_l_c.yaw()), RAD2DEG(r.T_l_c.pitch()), RAD2DEG(r.T_l_c.roll()),
            1e3 * r.rangeOffset};
}

/// In the same units.
double sigmaOf(const TLaserCameraCalibration& r, std::size_t i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double sigma = std::sqrt(r.covariance(k, k));
    return i >= 3 && i < 6 ? mrpt::RAD2DEG(sigma) : 1e3 * sigma;
}

std::string unitOf(std::size_t i) { return i >= 3 && i < 6 ? "deg" : "mm"; }

std::string stemOf(const std::string& file) { return std::filesystem::path(file).stem().string(); }

std::string poseText(const CPose3D& pose) {
    using mrpt::RAD2DEG;
    return fixed(pose.x(), 4) + " " + fixed(pose.y(), 4) + " " + fixed(pose.z(), 4) + " m, " +
           fixed(RAD2DEG(pose.yaw()), 3) + " " + fixed(RAD2DEG(pose.pitch()), 3) + " " +
           fixed(RAD2DEG(pose.roll()), 3) + " deg";
}

}  // namespace

CLaserCameraCommand::CLaserCameraCommand(CLI::App& app)
    : m_command(app.add_subcommand("laser-camera", kDescription)) {
    m_board.addTo(*m_command);
    m_command->add_option("--scans", m_scans,
                          "text file, a scan a line: stamp start step end limit count ranges...");
    m_command
        ->add_option("--first-scan", m_firstScan,
                     "line of the first picture's scan; the others follow (default 1)")
        ->check(CLI::PositiveNumber);
    m_command->add_flag("--clockwise", m_clockwise,
                        "the scans run clockwise, as of a laser that hangs upside down");
    m_command->add_option("--camera", m_camera,
                          "ini file with [CAMERA_PARAMS], as `camera` writes");
    m_command
        ->add_option("--laser-pose-m-deg", m_laserPose,
                     "x y z yaw pitch roll of the laser on the robot (default: all 0)")
        ->expected(6);
    m_command->add_option("--label", m_label, "sensor label of the camera (default CAMERA1)");
    m_command->add_option("--out", m_out, "folder for the results");
    m_command->add_option("--config", m_configFile, "ini file: [laser_camera]");
    m_command->add_flag("--print-config", m_printConfig, "print every key in use, and stop");
    // Examples belong to this command's own help, not to the list of commands.
    m_command->preparse_callback(
        [this](std::size_t) { m_command->description(std::string(kExamples) + kDescription); });
    m_command->callback([this] { checkUsage(); });
}

void CLaserCameraCommand::checkUsage() {
    if (m_printConfig) return;
    m_board.check();
    if (m_scans.empty()) throw CLI::RequiredError("--scans");
    if (m_camera.empty()) throw CLI::RequiredError("--camera");
    if (m_out.empty()) throw CLI::RequiredError("--out");
    for (const double value : m_laserPose)
        if (!std::isfinite(value))
            throw CLI::ValidationError("--laser-pose-m-deg", "must be six finite numbers");
    if (m_label.empty() || m_label.find_first_of("[]=\n/ ") != std::string::npos)
        throw CLI::ValidationError("--label", "'" + m_label + "' cannot name a section");
}

CPose3D CLaserCameraCommand::laserPose() const {
    using mrpt::DEG2RAD;
    const auto& p = m_laserPose;
    return CPose3D(p[0], p[1], p[2], DEG2RAD(p[3]), DEG2RAD(p[4]), DEG2RAD(p[5]));
}

CLaserCameraCommand::TRun CLaserCameraCommand::calibrate() const {
    TRun run;
    run.camera = observations::readCamera(m_camera);
    auto scans = calibration::readScans(m_scans, m_firstScan, m_board.images.size());
    run.seen = m_board.find();
    if (run.seen.size.width != static_cast<int>(run.camera.ncols) ||
        run.seen.size.height != static_cast<int>(run.camera.nrows))
        throw std::runtime_error(
            m_camera + ": is of pictures of " + std::to_string(run.camera.ncols) + "x" +
            std::to_string(run.camera.nrows) + ", but " + m_board.images.front() + " is " +
            std::to_string(run.seen.size.width) + "x" + std::to_string(run.seen.size.height));
    for (std::size_t i = 0; i < run.seen.boards.size(); ++i) {
        auto& scan = scans[run.seen.indices[i]];
        if (m_clockwise) scan.start = -scan.start, scan.step = -scan.step;
        const auto& board = run.seen.boards[i];
        std::optional<bool> dark;
        if (m_board.board.pattern == calibration::EPattern::chessboard)
            dark = calibration::firstSquareIsDark(board.grey, m_board.board, board.pixels);
        run.pairs.push_back({board.file, board.pixels, std::move(scan), dark});
    }
    run.result = calibration::CLaserCameraCalibrator(m_options).calibrate(run.camera, m_board.board,
                                                                          run.pairs);
    return run;
}

void CLaserCameraCommand::run(std::ostream& out) {
    if (!m_configFile.empty())
        m_options.loadFromConfigFile(*config::openStrict(m_configFile), "laser_camera");
    if (m_printConfig) {
        out << m_options.asIni("laser_camera");
        return;
    }
    COutputFolder folder(m_out);
    const TRun run = calibrate();
    writeResults(folder, run);
    writeReport(folder, run);
    folder.publish();
    const auto& result = run.result;
    out << result.usedPairs() << " of " << m_board.images.size()
        << " pictures and scans agree\ncamera in the laser's frame\n";
    for (std::size_t i = 0; i < kNames.size(); ++i)
        out << "  " << kNames[i] << " " << fixed(valuesOf(result)[i], 2) << " +- "
            << fixed(sigmaOf(result, i), 2) << " " << unitOf(i) << "\n";
    out << "  dark squares add " << fixed(1e3 * result.darkOffset, 2) << " +- "
        << fixed(1e3 * result.sigmaDark, 2) << " mm\n";
    out << "camera on the robot " << poseText(laserPose() + result.T_l_c) << "\n"
        << "median distance from the boards " << fixed(1e3 * result.medianFitted(), 1)
        << " mm fitted, " << fixed(1e3 * result.medianHeldOut(), 1) << " mm held out\n"
        << "report " << m_out << "/report.html\n";
}

void CLaserCameraCommand::writeResults(const COutputFolder& folder, const TRun& run) const {
    const auto& result = run.result;
    const CPose3D T_r_c = laserPose() + result.T_l_c;
    writeFile(folder / "camera.ini", cameraSection(run.camera));
    writeFile(folder / "sensors.ini", sensorSection(m_label, T_r_c));
    nlohmann::ordered_json json;
    for (std::size_t i = 0; i < kNames.size(); ++i)
        json["camera_in_laser_frame"][std::string(kNames[i]) + "_" + unitOf(i)] = {
            {"value", valuesOf(result)[i]}, {"sigma", sigmaOf(result, i)}};
    for (int r = 0; r < 7; ++r) {
        std::vector<double> row;
        for (int c = 0; c < 7; ++c) row.push_back(result.covariance(r, c));
        json["covariance_m_rad"].push_back(row);
    }
    json["dark_offset_m"] = {{"value", result.darkOffset}, {"sigma", result.sigmaDark}};
    json["sigma_range_m"] = result.sigmaRange;
    json["sigma_corner_px"] = result.sigmaPixels;
    json["median_distance_fitted_m"] = result.medianFitted();
    json["median_distance_heldout_m"] = result.medianHeldOut();  // null if there is none
    json["used_pairs"] = result.usedPairs();
    json["without_board"] = run.seen.without;
    writeFile(folder / "calibration.json", json.dump(2) + "\n");
    std::vector<TBoardDistances> distances;
    for (std::size_t i = 0; i < run.pairs.size(); ++i) {
        const auto& pair = result.pairs[i];
        const std::string stem = stemOf(run.pairs[i].name);
        distances.push_back({stem, pair.distances, pair.heldOutDistances});
        const auto overlay =
            drawLaser(run.seen.boards[i].grey, run.camera, run.pairs[i].scan, result, pair);
        const std::string file = folder / (stem + ".laser.png");
        if (!cv::imwrite(file, overlay)) throw std::runtime_error(file + ": cannot be written");
    }
    plotDistances(distances, folder / "distances.png");
}

void CLaserCameraCommand::writeReport(const COutputFolder& folder, const TRun& run) const {
    const auto& result = run.result;
    CHtmlPage page("Laser-camera calibration");
    std::vector<CHtmlPage::TRow> rows{{"camera in the laser's frame", "value", "sigma", "unit"}};
    for (std::size_t i = 0; i < kNames.size(); ++i)
        rows.push_back(
            {kNames[i], fixed(valuesOf(result)[i], 2), fixed(sigmaOf(result, i), 2), unitOf(i)});
    rows.push_back({"offset, dark squares add", fixed(1e3 * result.darkOffset, 2),
                    fixed(1e3 * result.sigmaDark, 2), "mm"});
    page.table(rows);
    page.paragraph("Camera on the robot: " + poseText(laserPose() + result.T_l_c) +
                   " (x y z, yaw pitch roll). Optical frame: z forward, x right, y down. offset: "
                   "measured minus true range.");
    page.paragraph("Noise, from the residuals: ranges " + fixed(1e3 * result.sigmaRange, 1) +
                   " mm, corners " + fixed(result.sigmaPixels, 2) +
                   " px. Sigmas take these errors for independent, and the camera's intrinsics for "
                   "exact.");
    page.heading("Distances");
    page.paragraph("Median distance of ends of beams from the boards as the pictures show them: " +
                   fixed(1e3 * result.medianFitted(), 1) + " mm for boards in the fit, " +
                   fixed(1e3 * result.medianHeldOut(), 1) + " mm for boards left out of it.");
    page.picture(folder / "distances.png", "Distances of ends of beams from the boards.");
    page.heading("The laser in the pictures");
    std::size_t shown = 0;
    for (std::size_t i = 0; i < run.pairs.size() && shown < 4; ++i) {
        if (!result.pairs[i].used) continue;
        if (shown * run.pairs.size() / 4 > i) continue;
        page.picture(folder / (stemOf(run.pairs[i].name) + ".laser.png"),
                     stemOf(run.pairs[i].name) + ": beams on the board green, others orange");
        ++shown;
    }
    rows = {{"picture", "beams", "mean distance [mm]", "held out [mm]"}};
    const auto mean = [](const std::vector<double>& values) {
        double sum = 0;
        for (const double v : values) sum += v;
        return 1e3 * sum / static_cast<double>(values.size());  // NaN if there are none
    };
    for (std::size_t i = 0; i < run.pairs.size(); ++i)
        rows.push_back({run.pairs[i].name, std::to_string(result.pairs[i].beams.size()),
                        fixed(mean(result.pairs[i].distances), 1),
                        fixed(mean(result.pairs[i].heldOutDistances), 1)});
    for (const auto& file : run.seen.without) rows.push_back({file, "no board", "-", "-"});
    page.table(rows);
    writeFile(folder / "report.html", page.html());
}

}  // namespace salma::apps
