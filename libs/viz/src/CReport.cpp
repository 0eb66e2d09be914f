// SPDX-License-Identifier: BSD-3-Clause
#include <salma/viz/CReport.h>
#include <salma/viz/CTrajectoryScore.h>
#include <salma/viz/doubtfulPairings.h>
#include <salma/viz/reportStyle.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <utility>

#include "CTextFile.h"

namespace salma::viz {
namespace {

using association::ELandmarkKind;
using mrpt::math::TPoint2D;

std::string embedded(const std::string& png) { return "data:image/png;base64," + base64(png); }

/// The patch as a PNG; "" where it has no picture.
std::string patchPng(const observations::TPatch& patch) {
    if (patch.picture.isEmpty()) return "";
    const auto pixels = patch.picture.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY);
    std::vector<unsigned char> bytes;
    cv::imencode(".png", pixels, bytes);
    return std::string(bytes.begin(), bytes.end());
}

std::string figure(const std::string& file, const std::string& name, const std::string& caption) {
    return "<figure><img alt=\"" + name + "\" src=\"" + embedded(readText(file)) +
           "\"><figcaption>" + caption + "</figcaption></figure>\n";
}

std::string tile(const std::string& value, const std::string& name) {
    return "<div class=\"tile\"><b>" + value + "</b><span>" + name + "</span></div>\n";
}

std::string cell(const std::string& text) { return "<td>" + text + "</td>"; }

std::string plusMinus(double value, double sigma) {
    return fixed(value, 2) + " &plusmn; " + fixed(sigma, 3);
}

/// A picture of the patch, or a dash.
std::string patchFigure(const std::shared_ptr<const observations::TPatch>& patch,
                        const std::string& name) {
    const std::string png = patch ? patchPng(*patch) : "";
    if (png.empty()) return "&mdash;";
    return "<img class=\"patch\" alt=\"" + name + "\" src=\"" + embedded(png) + "\">";
}

std::string patchOfLandmark(const slam::TRunRecord& record, int id) {
    const auto found = std::find_if(record.landmarks.begin(), record.landmarks.end(),
                                    [id](const auto& l) { return l.id == id; });
    return patchFigure(found == record.landmarks.end() ? nullptr : found->patch,
                       "patch of landmark " + std::to_string(id));
}

std::string fixedOrDash(double value, int digits) {
    return std::isnan(value) ? "&mdash;" : fixed(value, digits);
}

std::string doubtfulRow(const slam::TRunRecord& record, const TDoubtfulPairing& doubtful) {
    const auto& made = record.associations[doubtful.row];
    const bool rivalled = doubtful.rival >= 0;
    return "<tr>" + cell(patchFigure(made.patch, "patch as seen")) +
           cell(patchOfLandmark(record, made.landmark)) +
           cell(fixed(made.time - record.trajectory.front().time, 1)) +
           cell(std::to_string(made.observation)) + cell(std::to_string(made.landmark)) +
           cell(fixedOrDash(made.distance2, 1)) + cell(fixedOrDash(made.logRatio, 1)) +
           cell(fixed(doubtful.margin, 1)) +
           cell(rivalled ? std::to_string(doubtful.rival) : "none") +
           cell(rivalled ? patchOfLandmark(record, doubtful.rival) : "&mdash;") +
           cell(fixedOrDash(doubtful.rivalDistance2, 1)) +
           cell(fixedOrDash(doubtful.rivalLogRatio, 1)) + "</tr>\n";
}

std::string landmarkRow(const slam::TMapLandmark& l, double start) {
    const std::string picture = patchFigure(l.patch, "patch of landmark " + std::to_string(l.id));
    std::string size = "&mdash;";
    if (l.patch) size = fixed(l.patch->width, 2) + " &times; " + fixed(l.patch->height, 2);
    return "<tr>" + cell(picture) + cell(std::to_string(l.id)) +
           cell(plusMinus(l.mean.x, std::sqrt(l.covariance(0, 0)))) +
           cell(plusMinus(l.mean.y, std::sqrt(l.covariance(1, 1)))) + cell(size) +
           cell(std::to_string(l.sightings)) + cell(fixed(l.firstTime - start, 1)) +
           cell(fixed(l.lastTime - start, 1)) + "</tr>\n";
}

std::size_t countKind(const slam::TRunRecord& record, ELandmarkKind kind) {
    return static_cast<std::size_t>(std::count_if(record.landmarks.begin(), record.landmarks.end(),
                                                  [&](const auto& l) { return l.kind == kind; }));
}

std::string scoreRow(const std::string& name, const TTrajectoryFigures& f) {
    return "<tr><th scope=\"row\">" + name + "</th>" + cell(fixed(f.aligned.rmse, 3)) +
           cell(fixed(f.aligned.mean, 3)) + cell(fixed(f.aligned.max, 3)) +
           cell(fixed(f.perMetres.translation.rmse, 3)) +
           cell(fixed(f.perMetres.rotation.rmse * 180 / M_PI, 2)) + "</tr>\n";
}

}  // namespace

std::string escapeHtml(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        switch (c) {
            case '&':
                escaped += "&amp;";
                break;
            case '<':
                escaped += "&lt;";
                break;
            case '>':
                escaped += "&gt;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            case '\'':
                escaped += "&#39;";
                break;
            default:
                escaped += c;
        }
    }
    return escaped;
}

std::string base64(const std::string& bytes) {
    constexpr auto alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = (group << 8U) |
                    (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : alphabet[(group >> (18 - 6 * k)) & 63U];
    }
    return text;
}

CReport::CReport(TReportInput input) : m_input(std::move(input)) {}

std::string CReport::html(const TReportFigures& figures) const {
    const auto& record = m_input.record;
    const std::string log = escapeHtml(record.logFile.substr(record.logFile.rfind('/') + 1));
    std::string page = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n";
    page += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
    page += "<title>salma: " + log + "</title>\n<style>" + std::string(kReportStyle) + "</style>";
    page += "</head>\n<body>\n<h1>" + (log.empty() ? std::string("A run") : log) + "</h1>\n";
    page += headline() + notices() + accuracy();
    page += "<h2>Map</h2>\n" +
            figure(figures.map, "map",
                   "Ellipses of the robot: green where no landmark was seen, blue at a first "
                   "sight, red at a sighting again. Landmarks: blue ellipse when first seen, red "
                   "at the end.");
    page += "<h2>Innovations</h2>\n" +
            figure(figures.innovations, "innovations",
                   "What was measured minus what the filter expected. A consistent filter keeps "
                   "about 95 % of them inside the bounds. Lines break where nothing known was "
                   "seen.");
    page += landmarkTable() + doubtfulTable() + refusals();
    page +=
        "<h2>Options</h2>\n<details><summary>The configuration that took effect</summary><pre>" +
        escapeHtml(record.options) + "</pre></details>\n";
    return page + "</body></html>\n";
}

std::string CReport::headline() const {
    const auto& record = m_input.record;
    const TDecisionCounts counts = countDecisions(record);
    const auto number = [](std::size_t n) { return std::to_string(n); };
    std::string text = "<div class=\"tiles\">\n";
    text += tile(number(record.trajectory.size()), "steps");
    text += tile(number(countKind(record, ELandmarkKind::salient)), "salient landmarks");
    text += tile(number(countKind(record, ELandmarkKind::corner)), "corners");
    text += tile(number(counts.paired), "paired");
    text += tile(number(counts.created), "new");
    text += tile(number(counts.deferred), "deferred");
    text += tile(number(counts.clutter), "clutter");
    if (counts.relocated > 0) text += tile(number(counts.relocated), "relocated");
    if (counts.provisional > 0) text += tile(number(counts.provisional), "provisional");
    text += tile(number(record.pictures), "pictures");
    text += tile(number(record.picturesWithoutLandmark), "pictures without landmark");
    text += tile(fixed(record.seconds, 1), "seconds");
    text += tile(std::to_string(record.seed), "seed");
    return text + "</div>\n";
}

std::string CReport::notices() const {
    if (m_input.record.notices.empty()) return "";
    std::string text = "<div class=\"notices\"><h2>Notices</h2><ul>\n";
    for (const auto& notice : m_input.record.notices)
        text += "<li>" + escapeHtml(notice) + "</li>\n";
    return text + "</ul></div>\n";
}

std::string CReport::refusals() const {
    const auto& record = m_input.record;
    if (record.refused.empty() && record.splitGroups == 0) return "";
    std::string rows;
    for (const auto& [reason, count] : record.refused)
        rows +=
            "<tr><td>" + escapeHtml(reason) + "</td><td>" + std::to_string(count) + "</td></tr>\n";
    return "<h2>Not taken from pictures</h2>\n<table><thead><tr><th>reason</th>"
           "<th>count</th></tr></thead><tbody>\n" +
           rows +
           "</tbody></table>\n<p>Groups of regions that lay on several walls and were split: " +
           std::to_string(record.splitGroups) + ".</p>\n";
}

std::string CReport::accuracy() const {
    if (!m_input.truth) return "";
    const CTrajectoryScore score;
    std::string rows;
    try {
        const auto& record = m_input.record;
        rows = scoreRow("estimate", score.compare(*m_input.truth, estimatedPath(record)));
        rows += scoreRow("odometry alone", score.compare(*m_input.truth, odometryPath(record)));
    } catch (const std::invalid_argument& e) {
        return "<h2>Against the true path</h2>\n<p>Not compared: " + escapeHtml(e.what()) +
               ".</p>\n";
    }
    return "<h2>Against the true path</h2>\n<table><thead><tr><th></th><th>ATE RMSE [m]</th>"
           "<th>mean [m]</th><th>max [m]</th><th>RPE per metre [m]</th><th>[deg]</th></tr></thead>"
           "<tbody>\n" +
           rows +
           "</tbody></table>\n<p>After the best rotation and translation in the plane.</p>\n";
}

std::string CReport::landmarkTable() const {
    const auto& record = m_input.record;
    const double start = record.trajectory.empty() ? 0 : record.trajectory.front().time;
    std::string rows;
    for (const auto& landmark : record.landmarks)
        if (landmark.kind == ELandmarkKind::salient) rows += landmarkRow(landmark, start);
    if (rows.empty()) return "<h2>Salient landmarks</h2>\n<p>None was found.</p>\n";
    return "<h2>Salient landmarks</h2>\n<table><thead><tr><th>patch</th><th>id</th>"
           "<th>x &plusmn; &sigma; [m]</th><th>y &plusmn; &sigma; [m]</th><th>size [m]</th>"
           "<th>sightings</th><th>first [s]</th><th>last [s]</th></tr></thead><tbody>\n" +
           rows + "</tbody></table>\n";
}

std::string CReport::doubtfulTable() const {
    const auto& record = m_input.record;
    std::string rows;
    if (!record.trajectory.empty())
        for (const auto& doubtful : doubtfulPairings(record)) rows += doubtfulRow(record, doubtful);
    if (rows.empty()) return "";
    return "<h2>The most doubtful pairings</h2>\n<p>Pairings of salient landmarks that came "
           "nearest to being another or none. Margin: log likelihood (log LR - d&sup2;/2) above "
           "that of the rival, the next best landmark, or above the edge of the gate where there "
           "is none. A log LR of 0: the look had counted before in this track; none: the method "
           "does not look at appearance, or it could not tell.</p>\n<table><thead><tr><th>seen</th>"
           "<th>landmark</th><th>t [s]</th><th>observation</th><th>id</th><th>d&sup2;</th>"
           "<th>log LR</th><th>margin</th><th>rival</th><th></th><th>its d&sup2;</th>"
           "<th>its log LR</th></tr></thead><tbody>\n" +
           rows + "</tbody></table>\n";
}

}  // namespace salma::viz
