// SPDX-License-Identifier: BSD-3-Clause
// Draws scans of real logs with the lines found in them.
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <salma/laser/CCornerExtractor.h>
#include <salma/observations/CLogReader.h>
#include <salma/observations/readCarmenLog.h>
#include <salma/viz/CGnuplot.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>

namespace {

using namespace salma;
using Scan = mrpt::obs::CObservation2DRangeScan;

std::vector<Scan::Ptr> scansOf(const std::string& file) {
    std::vector<Scan::Ptr> scans;
    if (std::filesystem::path(file).extension() != ".rawlog") {
        for (const auto& entry : observations::readCarmenLog(file).scans)
            scans.push_back(entry.scan);
        return scans;
    }
    for (const auto& step : observations::readLog(file).steps)
        for (const auto& observation : step.observations)
            if (const auto scan = std::dynamic_pointer_cast<Scan>(observation))
                scans.push_back(scan);
    return scans;
}

void draw(const Scan& scan, const std::string& title, int panel, viz::CGnuplot& plot) {
    const laser::TLineOptions options;
    const auto lines = laser::CLineExtractor(options).extract(scan);
    const auto corners = laser::CCornerExtractor().extract(lines);
    const std::string id = std::to_string(panel);
    auto& points = plot.data("points" + id);
    const double step = scan.aperture / static_cast<double>(scan.getScanSize() - 1);
    for (std::size_t i = 0; i < scan.getScanSize(); ++i) {
        const double range = scan.getScanRange(i);
        if (!scan.getScanRangeValidity(i) || range > options.maxRange) continue;
        const double bearing =
            (scan.rightToLeft ? 1 : -1) * (step * static_cast<double>(i) - scan.aperture / 2.0);
        double x = 0, y = 0, z = 0;
        scan.sensorPose.composePoint(range * std::cos(bearing), range * std::sin(bearing), 0, x, y,
                                     z);
        points << -y << ' ' << x << '\n';
    }
    points << "nan nan\n";
    plot.endData();
    auto& segments = plot.data("lines" + id);
    for (const auto& line : lines.lines)
        segments << -line.from.y << ' ' << line.from.x << '\n'
                 << -line.to.y << ' ' << line.to.x << "\n\n";
    segments << "nan nan\n";
    plot.endData();
    auto& marks = plot.data("corners" + id);
    for (const auto& corner : corners.corners)
        marks << -corner.position.y << ' ' << corner.position.x << '\n';
    marks << "nan nan\n";
    plot.endData();
    plot.script() << "set title '" << title << ": " << lines.lines.size() << " lines'\n"
                  << "plot $points" << id << " with points pt 7 ps 0.4 lc rgb '#888888', $lines"
                  << id << " with lines lw 3 lc rgb '#c03020', $corners" << id
                  << " with points pt 6 ps 1.6 lw 2 lc rgb '#2050b0'\n";
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Lines (red) and corners (blue) in scans (grey) of CARMEN logs and rawlogs");
    std::vector<std::string> files;
    std::vector<std::size_t> scans{100};
    std::string out{"lines.png"};
    app.add_option("logs", files, "CARMEN logs or rawlogs")->required();
    app.add_option("--scans", scans, "number of the scan of each log, the last for all others");
    app.add_option("--out", out, "picture");
    CLI11_PARSE(app, argc, argv);
    try {
        const int columns = files.size() > 1 ? 2 : 1;
        const int rows = (static_cast<int>(files.size()) + columns - 1) / columns;
        viz::CGnuplot plot(700 * columns, 560 * rows);
        plot.script() << "set multiplot layout " << rows << ',' << columns
                      << "\nset size ratio -1\nset key off\nset grid lc rgb '#dddddd'\n"
                      << "set xlabel 'm'\n";
        for (std::size_t k = 0; k < files.size(); ++k) {
            const auto all = scansOf(files[k]);
            const std::size_t number = scans[std::min(k, scans.size() - 1)];
            if (number >= all.size())
                throw std::runtime_error(files[k] + ": has only " + std::to_string(all.size()) +
                                         " scans");
            std::string name = std::filesystem::path(files[k]).filename().string();
            name = name.substr(0, name.find_first_of(". _"));
            draw(*all[number], name + ", scan " + std::to_string(number), static_cast<int>(k),
                 plot);
        }
        plot.script() << "unset multiplot\n";
        plot.run(out);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "line-overlay: %s\n", error.what());
        return 1;
    }
    return 0;
}
