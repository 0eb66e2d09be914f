// SPDX-License-Identifier: BSD-3-Clause
#include <salma/viz/CGnuplot.h>
#include <salma/viz/CPlots.h>
#include <salma/viz/CTrajectoryScore.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>

#include "CTextFile.h"
#include "TPlotFrame.h"

namespace salma::viz {
namespace {

using association::ELandmarkKind;
using mrpt::math::TPoint2D;
using slam::ESight;
using slam::TMapLandmark;
using slam::TRunRecord;
using slam::TTrajectoryRow;
using Path = std::vector<TPoint2D>;

constexpr std::size_t kMaxScanPoints = 150000;  // more only make the same grey
constexpr double kSigmas = 2;

constexpr auto kGreen = "#2ca02c", kBlue = "#1f5fd0", kRed = "#d62728";

/// An ellipse of kSigmas, as gnuplot draws one: full axes [m], direction of the first [deg].
struct TEllipse {
    double major{0}, minor{0}, angle{0};
};

TEllipse ellipseOf(const Eigen::Matrix2d& covariance) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(covariance);
    const auto axis = [&](int i) {
        return 2 * kSigmas * std::sqrt(std::max(0.0, eigen.eigenvalues()[i]));
    };
    const Eigen::Vector2d direction = eigen.eigenvectors().col(1);
    return {axis(1), axis(0), std::atan2(direction.y(), direction.x()) * 180 / M_PI};
}

TEllipse ellipseOf(const TTrajectoryRow& row) {
    return ellipseOf(Eigen::Matrix2d(row.covariance.topLeftCorner<2, 2>()));
}

/// 1, 2, 5, ... up to 20: what makes the 90 % quantile of the robot's ellipses at least 1 % of the
/// map wide.
double enlargement(const TRunRecord& record, const TPlotFrame& frame) {
    std::vector<double> widths;
    for (const auto& row : record.trajectory) widths.push_back(ellipseOf(row).major);
    if (widths.empty()) return 1;
    const auto nth = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() * 9 / 10);
    std::nth_element(widths.begin(), nth, widths.end());
    double factor = 1;
    for (const double larger : {2, 5, 10, 20})
        if (*nth * factor < 0.01 * frame.width()) factor = larger;
    return factor;
}

Path estimatedPath(const TRunRecord& record) {
    Path path;
    for (const auto& row : record.trajectory) path.emplace_back(row.pose.x(), row.pose.y());
    return path;
}

/// Odometry alone, moved so that it starts where the estimate starts.
Path odometryPath(const TRunRecord& record) {
    Path path;
    for (const auto& row : record.trajectory) {
        const auto& first = record.trajectory.front();
        const auto pose = first.pose + (row.odometry - first.odometry);
        path.emplace_back(pose.x(), pose.y());
    }
    return path;
}

/// The true path in the frame of the estimate; empty where none is known.
Path truePath(const TReportInput& input) {
    if (!input.truth) return {};
    std::vector<mrpt::poses::CPose2D> truth, estimate;
    for (const auto& row : input.record.trajectory) {
        mrpt::poses::CPose2D pose;
        if (!interpolate(*input.truth, row.time, TScoreOptions().maxGap, pose)) continue;
        truth.push_back(pose);
        estimate.push_back(row.pose);
    }
    if (truth.empty()) return {};
    const auto T_w_truth = alignment(truth, estimate);
    Path path;
    for (const auto& pose : truth) {
        const auto moved = T_w_truth + pose;
        path.emplace_back(moved.x(), moved.y());
    }
    return path;
}

class CMapDrawing {
 public:
    explicit CMapDrawing(const TReportInput& input)
        : m_record(input.record),
          m_estimate(estimatedPath(input.record)),
          m_odometry(odometryPath(input.record)),
          m_truth(truePath(input)),
          m_plot(1600, 1200) {
        for (const auto* path : {&m_estimate, &m_odometry, &m_truth})
            for (const auto& point : *path) m_frame.include(point);
        for (const auto& landmark : m_record.landmarks) m_frame.include(landmark.mean);
        m_frame.includeMost(m_record.scanPoints);
        m_frame.fit(kPlotWidth / kPlotHeight);
        m_enlargement = enlargement(m_record, m_frame);
    }

    void draw(const std::string& file) {
        scanPoints();
        line(m_odometry, "odometry", "lw 1.5 lc rgb '#909090'", "odometry alone");
        robotEllipses(ESight::nothing, kGreen, "robot, no landmark seen");
        robotEllipses(ESight::first, kBlue, "robot, a landmark seen first");
        robotEllipses(ESight::again, kRed, "robot, a landmark seen again");
        landmarkEllipses();
        line(m_truth, "truth", "lw 3 dt (8,5) lc rgb '#ff9800'", "true path");
        line(m_estimate, "estimate", "lw 2.2 lc rgb '#000000'", "estimated path");
        landmarks(ELandmarkKind::corner, "pt 1 ps 1.1 lw 1.4 lc rgb '#b05050'", "corner");
        landmarks(ELandmarkKind::salient, "pt 1 ps 2.6 lw 3.4 lc rgb '#d62728'",
                  "salient landmark");
        ends();
        labels();
        decorate();
        m_plot.script() << "plot " << (m_elements.empty() ? "NaN notitle" : m_elements) << "\n";
        m_plot.run(file);
    }

 private:
    static constexpr double kPlotWidth = 1480, kPlotHeight = 950;  // [px], see decorate()

    void element(const std::string& text) { m_elements += (m_elements.empty() ? "" : ", ") + text; }

    void scanPoints() {
        const auto& points = m_record.scanPoints;
        if (points.empty()) return;
        const std::size_t stride = points.size() / kMaxScanPoints + 1;
        auto& out = m_plot.data("scans");
        for (std::size_t i = 0; i < points.size(); i += stride) out << asText(points[i]) << "\n";
        m_plot.endData();
        element("$scans using 1:2 with points pt 7 ps 0.22 lc rgb '#cfcfcf' notitle");
        element("NaN with points pt 7 ps 1 lc rgb '#bdbdbd' title 'laser'");
    }

    void line(const Path& path,
              const std::string& name,
              const std::string& style,
              const std::string& title) {
        if (path.empty()) return;
        auto& out = m_plot.data(name);
        for (const auto& point : path) out << asText(point) << "\n";
        m_plot.endData();
        element("$" + name + " using 1:2 with lines " + style + " title '" + title + "'");
    }

    std::string asLine(const TPoint2D& centre, const TEllipse& e) const {
        return asText(centre) + " " + number(e.major * m_enlargement) + " " +
               number(e.minor * m_enlargement) + " " + number(e.angle) + "\n";
    }

    /// An ellipse wherever the robot has moved on by a fortieth of the map since the last.
    void robotEllipses(ESight sight, const std::string& colour, const std::string& title) {
        const double spacing = m_frame.width() / 40;
        std::string lines;
        const TTrajectoryRow* last = nullptr;
        for (const auto& row : m_record.trajectory) {
            if (row.sight != sight) continue;
            if (last != nullptr && row.pose.distanceTo(last->pose) < spacing) continue;
            last = &row;
            const TEllipse ellipse = ellipseOf(row);
            if (!(ellipse.major > 0)) continue;  // gnuplot has a size of its own for these
            lines += asLine({row.pose.x(), row.pose.y()}, ellipse);
        }
        ellipses("robot" + std::to_string(static_cast<int>(sight)), lines,
                 "lw 1.6 lc rgb '" + colour + "' title '" + title + "'");
    }

    void landmarkEllipses() {
        std::string first, later;
        for (const auto& l : m_record.landmarks) {
            first += asLine(l.firstMean, ellipseOf(l.firstCovariance));
            if (l.sightings > 1) later += asLine(l.mean, ellipseOf(l.covariance));
        }
        ellipses("first", first, "lw 1.1 lc rgb '#1f5fd0' title 'landmark, first seen'");
        ellipses("later", later, "lw 1.1 lc rgb '#d62728' title 'landmark, seen again'");
    }

    void ellipses(const std::string& name, const std::string& lines, const std::string& style) {
        if (lines.empty()) return;
        m_plot.data(name) << lines;
        m_plot.endData();
        element("$" + name + " using 1:2:3:4:5 with ellipses units xx fs empty border " + style);
    }

    void landmarks(ELandmarkKind kind, const std::string& style, const std::string& title) {
        std::string lines;
        for (const auto& l : m_record.landmarks)
            if (l.kind == kind) lines += asText(l.mean) + "\n";
        if (lines.empty()) return;
        const std::string name = nameOf(kind);
        m_plot.data(name) << lines;
        m_plot.endData();
        element("$" + name + " using 1:2 with points " + style + " title '" + title + "'");
    }

    void ends() {
        if (m_estimate.empty()) return;
        m_plot.data("ends") << asText(m_estimate.front()) << "\n";
        m_plot.endData();
        element("$ends using 1:2 with points pt 7 ps 1.8 lc rgb '#000000' title 'start'");
    }

    /// Ids of the salient landmarks, each away from the middle of the path.
    void labels() {
        for (const auto& l : m_record.landmarks) {
            if (l.kind != ELandmarkKind::salient) continue;
            m_plot.script() << "set label '" << l.id << "' at " << number(l.mean.x) << ","
                            << number(l.mean.y)
                            << " offset character 0.9,0.7 front font ',15' textcolor rgb "
                               "'#7a0f10'\n";
        }
    }

    void decorate() {
        auto& out = m_plot.script();
        out << "set lmargin at screen " << number(80.0 / 1600) << "\nset rmargin at screen "
            << number((80 + kPlotWidth) / 1600) << "\nset bmargin at screen "
            << number(185.0 / 1200) << "\nset tmargin at screen "
            << number((185 + kPlotHeight) / 1200) << "\nset size ratio -1\n";
        out << "set xrange [" << number(m_frame.min.x) << ":" << number(m_frame.max.x)
            << "]\nset yrange [" << number(m_frame.min.y) << ":" << number(m_frame.max.y) << "]\n";
        out << "set xlabel 'x [m]' offset 0,0.4\nset ylabel 'y [m]' offset 1,0\n"
            << "set grid lc rgb '#ececec' lt 1 lw 1\nset border lw 1.2 lc rgb '#606060'\n"
            << "set tics textcolor rgb '#303030'\n"
            << "set key at screen 0.5,0.098 center top horizontal maxrows 3 samplen 2.5 width 1 "
               "Left "
               "reverse "
               "spacing 1.25 textcolor rgb '#202020' font ',13'\n";
        out << "set title '" << title() << "' font ',17' offset 0,-0.2\n";
    }

    std::string title() const {
        const auto salient =
            std::count_if(m_record.landmarks.begin(), m_record.landmarks.end(),
                          [](const TMapLandmark& l) { return l.kind == ELandmarkKind::salient; });
        const auto corners = static_cast<std::ptrdiff_t>(m_record.landmarks.size()) - salient;
        std::string text = std::to_string(salient) + " salient landmarks, " +
                           std::to_string(corners) + " corners, " +
                           std::to_string(m_record.trajectory.size()) + " steps; ellipses of " +
                           number(kSigmas) + " sigma";
        if (m_enlargement > 1) text += ", drawn " + number(m_enlargement) + " times as large";
        return text;
    }

    const TRunRecord& m_record;
    const Path m_estimate, m_odometry, m_truth;
    CGnuplot m_plot;
    TPlotFrame m_frame;
    double m_enlargement{1};
    std::string m_elements;
};

}  // namespace

void plotMap(const TReportInput& input, const std::string& file) { CMapDrawing(input).draw(file); }

}  // namespace salma::viz
