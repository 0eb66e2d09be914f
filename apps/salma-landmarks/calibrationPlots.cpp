// SPDX-License-Identifier: BSD-3-Clause
#include <salma/viz/CGnuplot.h>

#include <algorithm>
#include <cmath>

#include "calibrationFiles.h"

namespace salma::apps {
namespace {

constexpr double kDegrees = 180 / M_PI;
constexpr double kLowest = -6, kHighest = 8;  // of the axis of counted log ratios

void style(std::ostream& out) {
    out << "set grid lc rgb '#e6e6e6' lt 1 lw 1\nset border lw 1.2 lc rgb '#606060'\n"
        << "set tics textcolor rgb '#303030'\n";
}

void drawTable(viz::CGnuplot& plot,
               const TRatioTable& table,
               const std::string& name,
               const std::string& title) {
    auto& counted = plot.data("counted_" + name);
    for (const auto& bin : table.bins)
        counted << (bin.from + bin.to) / 2 << " " << bin.counted << " " << bin.same << " "
                << bin.other << "\n";
    plot.endData();
    auto& knots = plot.data("knots_" + name);
    for (std::size_t i = 0; i < table.scoreKnots.size(); ++i)
        knots << table.scoreKnots[i] << " " << table.logLrKnots[i] << "\n";
    plot.endData();
    plot.script() << "set title '" << title << "'\nset xlabel 'score'\n"
                  << "set ylabel 'log p(score|same) / p(score|other)'\n"
                  << "set xrange [0:1]\nset yrange [" << kLowest << ":" << kHighest
                  << "]\nset key left top\n"
                  << "plot $counted_" << name
                  << " using 1:2 with points pt 7 lc rgb '#1f5fd0' title 'counted, with prior', "
                  << "$knots_" << name
                  << " using 1:2 with lines lw 2 lc rgb '#d62728' title 'table', 0 with lines lc "
                     "rgb '#808080' notitle\n";
}

void drawCorrelation(viz::CGnuplot& plot, const TCalibration& c) {
    auto& out = plot.data("correlation");
    double last = 0;
    bool any = false;
    for (const auto& bin : c.decorrelated.bins)
        if (!std::isnan(bin.correlation)) {
            out << (bin.from + bin.to) / 2 * kDegrees << " " << bin.correlation << " " << bin.fitted
                << "\n";
            last = bin.to * kDegrees;
            any = true;
        }
    plot.endData();
    plot.script() << "set title 'two views of one track against a view of the map'\n"
                  << "set xlabel 'change of viewing angle [deg]'\n"
                  << "set ylabel 'correlation of log ratios'\nset key right top\n"
                  << "set xrange [0:" << std::max(10.0, last) << "]\nset yrange [-0.4:1]\n";
    if (!any)
        plot.script() << "plot NaN notitle\n";
    else
        plot.script() << "plot $correlation using 1:2 with points pt 7 lc rgb '#1f5fd0' title "
                         "'measured', $correlation using 1:3 with lines lw 2 lc rgb '#d62728' "
                         "title 'never rising', 0 with lines lc rgb '#808080' notitle\n";
}

void drawReliability(viz::CGnuplot& plot, const TReliability& r, const std::string& name) {
    auto& out = plot.data(name);
    for (const auto& bin : r.bins)
        out << bin.predicted << " " << std::clamp(bin.counted.value, kLowest, kHighest) << " "
            << std::clamp(bin.counted.low, kLowest, kHighest) << " "
            << std::clamp(bin.counted.high, kLowest, kHighest) << "\n";
    plot.endData();
}

void drawSet(viz::CGnuplot& plot, const TRunSet& set, const std::string& name) {
    drawReliability(plot, set.learned, name + "_learned");
    drawReliability(plot, set.configured, name + "_configured");
    plot.script() << "set title '" << name << " runs: " << set.posters << " pictures, "
                  << set.learned.same << " pairs of the same, " << set.learned.other
                  << " of others'\n"
                  << "plot x with lines lc rgb '#808080' title 'as predicted', $" << name
                  << "_configured using 1:2:3:4 with yerrorbars pt 6 lw 1.2 lc rgb '#e07b00' "
                     "title 'tables of the configuration', $"
                  << name
                  << "_learned using 1:2:3:4 with yerrorbars pt 7 lw 1.6 lc rgb '#1f5fd0' title "
                     "'learned tables'\n";
}

}  // namespace

void plotTables(const TCalibration& c, const std::string& file) {
    viz::CGnuplot plot(1800, 600);
    style(plot.script());
    plot.script() << "set multiplot layout 1,3\n";
    drawTable(plot, c.both, "both", "keypoints and regions");
    drawTable(plot, c.keypoints, "keypoints", "keypoints alone");
    drawCorrelation(plot, c);
    plot.script() << "unset multiplot\n";
    plot.run(file);
}

void plotReliability(const TCalibration& c, const std::string& file) {
    viz::CGnuplot plot(c.report ? 1600 : 800, 760);
    style(plot.script());
    plot.script() << "set multiplot layout 1," << (c.report ? 2 : 1) << "\nset key left top\n"
                  << "set xlabel 'predicted log ratio'\n"
                  << "set ylabel 'counted log ratio (bars: Clopper-Pearson 95 %, by pairs; cut at "
                  << kLowest << " and " << kHighest << ")'\n"
                  << "set xrange [-5:6]\nset yrange [" << kLowest << ":" << kHighest << "]\n";
    drawSet(plot, c.learning, "learning");
    if (c.report) drawSet(plot, *c.report, "report");
    plot.script() << "unset multiplot\n";
    plot.run(file);
}

}  // namespace salma::apps
