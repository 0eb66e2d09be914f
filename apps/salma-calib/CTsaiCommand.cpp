// SPDX-License-Identifier: BSD-3-Clause
#include "CTsaiCommand.h"

#include <salma/config/CStrictFile.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "CHtmlPage.h"
#include "COutputFolder.h"
#include "cameraFiles.h"
#include "readPicture.h"
#include "residualPlots.h"

namespace salma::apps {
namespace {

using calibration::TSpacePoint;
using calibration::TTsaiResult;

constexpr auto kDescription = "A camera from one photograph of two checkerboards at a right angle.";
constexpr auto kExamples =
    "Examples:\n"
    "  salma-calib tsai grid.jpg --square-m 0.02 --out out/tsai\n"
    "  salma-calib tsai grid.jpg --square-m 0.02 --check points.txt --check-unit-m 0.001 --out "
    "out/tsai\n\n";
constexpr int kMostShift = 30;  ///< [squares] Of the check's origin.

mrpt::img::TCamera pinholeOf(const TTsaiResult& result, const cv::Size& size) {
    const auto& K = result.camera.K();
    mrpt::img::TCamera camera;
    camera.ncols = static_cast<std::uint32_t>(size.width);
    camera.nrows = static_cast<std::uint32_t>(size.height);
    camera.setIntrinsicParamsFromValues(K(0, 0), K(1, 1), K(0, 2), K(1, 2));
    camera.setDistortionPlumbBob(0, 0, 0, 0, 0);
    return camera;
}

template <class MATRIX>
std::vector<std::vector<double>> rowsOf(const MATRIX& matrix) {
    std::vector<std::vector<double>> rows;
    for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
        rows.emplace_back();
        for (Eigen::Index c = 0; c < matrix.cols(); ++c) rows.back().push_back(matrix(r, c));
    }
    return rows;
}

std::string pointTable(const TTsaiResult& result) {
    std::string text = "x_m,y_m,z_m,u_px,v_px,du_px,dv_px,used\n";
    for (const bool used : {true, false})
        for (const auto& p : used ? result.points : result.outliers) {
            const auto miss = p.pixel - result.camera.project(p.world);
            for (const double value : {p.world.x, p.world.y, p.world.z})
                text += fixed(value, 4) + ",";
            for (const double value : {p.pixel.x, p.pixel.y, miss.x, miss.y})
                text += fixed(value, 3) + ",";
            text += used ? "1\n" : "0\n";
        }
    return text;
}

/// The picture with corners as found (green; left out: orange) and as the camera expects them
/// (red).
cv::Mat drawGrid(const cv::Mat& grey, const TTsaiResult& result) {
    const double scale = std::min(1.0, 1400.0 / std::max(grey.cols, grey.rows));
    cv::Mat small, picture;
    cv::resize(grey, small, {}, scale, scale, cv::INTER_AREA);
    cv::cvtColor(small, picture, cv::COLOR_GRAY2BGR);
    const auto at = [&](const mrpt::math::TPoint2D& p) {
        return cv::Point(cvRound((p.x + 0.5) * scale - 0.5), cvRound((p.y + 0.5) * scale - 0.5));
    };
    for (const bool used : {true, false})
        for (const auto& p : used ? result.points : result.outliers) {
            cv::circle(picture, at(p.pixel), 6,
                       used ? cv::Scalar(60, 200, 0) : cv::Scalar(0, 130, 255), 2, cv::LINE_AA);
            cv::drawMarker(picture, at(result.camera.project(p.world)), cv::Scalar(0, 0, 230),
                           cv::MARKER_CROSS, 9, 1, cv::LINE_AA);
        }
    return picture;
}

}  // namespace

CTsaiCommand::CTsaiCommand(CLI::App& app) : m_command(app.add_subcommand("tsai", kDescription)) {
    m_command->add_option("IMAGE", m_image, "photograph of the grid");
    m_command->add_option("--square-m,--square_m", m_square, "side of a square");
    m_command->add_option("--check", m_check, "text file of points x y z u v, not used in the fit");
    m_command->add_option("--check-unit-m", m_checkUnit, "metres of its unit (default 1)");
    m_command->add_option("--out", m_out, "folder for the results");
    m_command->add_option("--config", m_configFile, "ini file: [tsai_grid]");
    m_command->add_flag("--print-config", m_printConfig, "print every key in use, and stop");
    // Examples belong to this command's own help, not to the list of commands.
    m_command->preparse_callback(
        [this](std::size_t) { m_command->description(std::string(kExamples) + kDescription); });
    m_command->callback([this] {
        if (m_printConfig) return;
        if (m_image.empty()) throw CLI::RequiredError("IMAGE");
        if (m_out.empty()) throw CLI::RequiredError("--out");
        for (const double length : {m_square, m_checkUnit})
            if (!(length > 0) || !std::isfinite(length))
                throw CLI::ValidationError("--square-m, --check-unit-m", "must be above 0");
    });
}

CTsaiCommand::TCheck CTsaiCommand::check(const TTsaiResult& result) const {
    const auto points = calibration::readPoints(m_check, m_checkUnit);
    if (points.empty()) throw std::runtime_error(m_check + ": holds no points");
    TCheck best{points.size(), 0, std::numeric_limits<double>::infinity()};
    for (int shift = -kMostShift; shift <= kMostShift; ++shift) {
        auto moved = points;
        for (auto& p : moved) p.world.x += shift * m_square;
        const double rms = result.camera.rms(moved);
        if (rms < best.rms) best = {points.size(), shift, rms};
    }
    return best;
}

void CTsaiCommand::run(std::ostream& out) {
    if (!m_configFile.empty())
        m_options.loadFromConfigFile(*config::openStrict(m_configFile), "tsai_grid");
    if (m_printConfig) {
        out << m_options.asIni("tsai_grid");
        return;
    }
    COutputFolder folder(m_out);
    const cv::Mat grey = readGrey(m_image);
    TTsaiResult result = [&] {
        try {
            return calibration::CTsaiGrid(m_options).calibrate(grey, m_square);
        } catch (const std::runtime_error& e) {
            throw std::runtime_error(m_image + ": " + e.what());
        }
    }();
    const auto& K = result.camera.K();
    std::string summary =
        std::to_string(result.points.size()) + " corners, " +
        std::to_string(result.outliers.size()) + " left out\nfx " + fixed(K(0, 0), 2) + " fy " +
        fixed(K(1, 1), 2) + " cx " + fixed(K(0, 2), 2) + " cy " + fixed(K(1, 2), 2) + " skew " +
        fixed(K(0, 1), 2) + "\nreprojection error " + fixed(result.camera.rms(result.points), 3) +
        " px, linear " + fixed(result.linearRms, 3) + " px\n";
    if (!m_check.empty()) {
        const TCheck found = check(result);
        summary += "check: " + std::to_string(found.points) + " points, " + fixed(found.rms, 3) +
                   " px, shifted by " + std::to_string(found.shift) + " squares\n";
    }
    writeResults(folder, grey, result, summary);
    folder.publish();
    out << summary << "report " << m_out << "/report.html\n";
}

void CTsaiCommand::writeResults(const COutputFolder& folder,
                                const cv::Mat& grey,
                                const TTsaiResult& result,
                                const std::string& summary) const {
    const auto camera = pinholeOf(result, grey.size());
    writeFile(folder / "camera.ini", cameraSection(camera));
    writeFile(folder / "camera.yaml", cameraYaml(camera, "camera"));
    writeFile(folder / "points.csv", pointTable(result));
    nlohmann::ordered_json json;
    json["K_px"] = rowsOf(result.camera.K());
    json["R"] = rowsOf(result.camera.R());
    json["t_m"] = rowsOf(result.camera.t().transpose())[0];
    json["P"] = rowsOf(result.camera.P());
    json["rms_px"] = result.camera.rms(result.points);
    json["linear_rms_px"] = result.linearRms;
    json["points"] = result.points.size();
    json["outliers"] = result.outliers.size();
    writeFile(folder / "calibration.json", json.dump(2) + "\n");
    TResidualPlot plot;
    plot.size = grey.size();
    for (const auto& p : result.points) {
        plot.places.push_back(p.pixel);
        plot.fitted.push_back(p.pixel - result.camera.project(p.world));
    }
    plotResiduals(plot, folder / "residuals.png");
    if (!cv::imwrite(folder / "grid.png", drawGrid(grey, result)))
        throw std::runtime_error((folder / "grid.png").string() + ": cannot be written");
    CHtmlPage page("Tsai grid");
    page.paragraph(m_image + ", " + std::to_string(grey.cols) + " x " + std::to_string(grey.rows));
    for (std::size_t from = 0; from < summary.size();) {
        const std::size_t end = summary.find('\n', from);
        page.paragraph(summary.substr(from, end - from));
        from = end + 1;
    }
    page.picture(folder / "residuals.png",
                 "Left: seen minus expected place of each corner. Right: the same where it was "
                 "seen, enlarged.");
    page.picture(folder / "grid.png",
                 "Corners as found (green; left out of the fit: orange) and as the camera expects "
                 "them (red crosses).");
    writeFile(folder / "report.html", page.html());
}

}  // namespace salma::apps
