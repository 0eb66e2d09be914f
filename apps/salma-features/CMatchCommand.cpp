// SPDX-License-Identifier: BSD-3-Clause
#include "CMatchCommand.h"

#include <salma/config/CStrictFile.h>

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "COutputFolder.h"
#include "readPicture.h"

namespace salma::apps {
namespace {

using appearance::TPictureMatch;

constexpr auto kDescription = "Tells whether two pictures show the same poster, sign or wall.";
constexpr auto kExamples =
    "Examples:\n"
    "  salma-features match poster-left.jpg poster-right.jpg --out out/match\n"
    "  salma-features match a.png b.png --config my.ini --out out/match\n\n";

void writePairs(const std::string& file, const TPictureMatch& match) {
    std::ofstream out(file);
    out << "xa_px,ya_px,xb_px,yb_px\n" << std::fixed << std::setprecision(2);
    for (const auto& p : match.pairs)
        out << p.first.x << "," << p.first.y << "," << p.second.x << "," << p.second.y << "\n";
    out.close();
    if (!out) throw std::runtime_error(file + ": cannot be written");
}

/// Both pictures side by side, with a line for each agreeing pair.
void writeOverlay(const std::string& file,
                  const cv::Mat& a,
                  const cv::Mat& b,
                  const TPictureMatch& match) {
    cv::Mat canvas(std::max(a.rows, b.rows), a.cols + b.cols, CV_8UC3, cv::Scalar::all(0));
    cv::Mat left = canvas(cv::Rect(0, 0, a.cols, a.rows));
    cv::Mat right = canvas(cv::Rect(a.cols, 0, b.cols, b.rows));
    cv::cvtColor(a, left, cv::COLOR_GRAY2BGR);
    cv::cvtColor(b, right, cv::COLOR_GRAY2BGR);
    const cv::Scalar colours[] = {{80, 220, 80}, {255, 180, 60}, {60, 200, 255}, {220, 100, 220}};
    for (std::size_t i = 0; i < match.pairs.size(); ++i) {
        const auto& p = match.pairs[i];
        const cv::Point from(cvRound(p.first.x), cvRound(p.first.y));
        const cv::Point to(a.cols + cvRound(p.second.x), cvRound(p.second.y));
        cv::line(canvas, from, to, colours[i % 4], 1, cv::LINE_AA);
        cv::circle(canvas, from, 3, colours[i % 4], 1, cv::LINE_AA);
        cv::circle(canvas, to, 3, colours[i % 4], 1, cv::LINE_AA);
    }
    if (!cv::imwrite(file, canvas)) throw std::runtime_error(file + ": cannot be written");
}

}  // namespace

CMatchCommand::CMatchCommand(CLI::App& app) : m_command(app.add_subcommand("match", kDescription)) {
    m_command->add_option("A", m_first, "first picture");
    m_command->add_option("B", m_second, "second picture");
    m_command->add_option("--out", m_out, "folder for MATCHES.csv and OVERLAY.png");
    m_command->add_option("--config", m_configFile, "ini file: [picture_matcher]");
    m_command->add_flag("--print-config", m_printConfig, "print every key in use, and stop");
    // Examples belong to this command's own help, not to the list of commands.
    m_command->preparse_callback(
        [this](std::size_t) { m_command->description(std::string(kExamples) + kDescription); });
    m_command->callback([this] { checkUsage(); });
}

void CMatchCommand::checkUsage() const {
    if (m_printConfig) return;
    if (m_first.empty() || m_second.empty()) throw CLI::RequiredError("A and B");
    if (m_out.empty()) throw CLI::RequiredError("--out");
}

void CMatchCommand::run(std::ostream& out) {
    if (!m_configFile.empty())
        m_options.loadFromConfigFile(*config::openStrict(m_configFile), "picture_matcher");
    if (m_printConfig) {
        out << m_options.asIni("picture_matcher");
        return;
    }
    const cv::Mat a = readGrey(m_first);
    const cv::Mat b = readGrey(m_second);
    COutputFolder folder(m_out);
    const TPictureMatch match = appearance::CPictureMatcher(m_options).match(a, b);
    writePairs(folder / "MATCHES.csv", match);
    writeOverlay(folder / "OVERLAY.png", a, b, match);
    folder.publishInto();
    out << match.pairs.size() << " of " << match.putative << " pairs agree on one homography\n"
        << std::fixed << std::setprecision(3) << "score " << match.score << " log_lr "
        << match.logLikelihoodRatio << " decision " << asString(match.decision) << "\n";
}

}  // namespace salma::apps
