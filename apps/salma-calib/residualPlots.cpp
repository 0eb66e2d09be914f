// SPDX-License-Identifier: BSD-3-Clause
#include "residualPlots.h"

#include <salma/viz/CGnuplot.h>

#include <algorithm>
#include <cmath>

#include "cameraFiles.h"

namespace salma::apps {
namespace {

using mrpt::math::TPoint2D;

constexpr auto kFrame =
    "set grid lc rgb '#e6e6e6' lt 1 lw 1\nset border lw 1.2 lc rgb '#606060'\n"
    "set tics textcolor rgb '#303030'\nset key top right\n";

/// The value below which `share` of them lie; 0 if there are none.
double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

std::vector<double> lengths(const std::vector<TPoint2D>& vectors) {
    std::vector<double> all;
    for (const auto& v : vectors) all.push_back(std::hypot(v.x, v.y));
    return all;
}

void writePoints(viz::CGnuplot& plot,
                 const std::string& name,
                 const std::vector<TPoint2D>& points) {
    auto& out = plot.data(name);
    for (const auto& p : points) out << fixed(p.x, 5) << " " << fixed(p.y, 5) << "\n";
    plot.endData();
}

/// 1, 2 or 5 times a power of ten, not larger than `value`.
double roundedDown(double value) {
    const double power = std::pow(10, std::floor(std::log10(value)));
    for (const double digit : {5.0, 2.0})
        if (digit * power <= value) return digit * power;
    return power;
}

double medianAbsolute(const std::vector<TBoardDistances>& boards,
                      std::vector<double> TBoardDistances::*which) {
    std::vector<double> all;
    for (const auto& board : boards)
        for (const double d : board.*which) all.push_back(std::abs(d));
    return quantile(all, 0.5);
}

}  // namespace

void plotResiduals(const TResidualPlot& plot, const std::string& file) {
    viz::CGnuplot gnuplot(1600, 800);
    writePoints(gnuplot, "fitted", plot.fitted);
    if (!plot.heldOut.empty()) writePoints(gnuplot, "heldout", plot.heldOut);
    const double half = 1.1 * std::max({1e-6, quantile(lengths(plot.fitted), 1),
                                        quantile(lengths(plot.heldOut), 1)});
    const double usual = std::max(1e-6, quantile(lengths(plot.fitted), 0.5));
    const double enlarged = roundedDown(std::max(1.0, plot.size.width / 30.0 / usual));
    auto& arrows = gnuplot.data("arrows");
    for (std::size_t i = 0; i < plot.places.size(); ++i)
        arrows << fixed(plot.places[i].x, 3) << " " << fixed(plot.places[i].y, 3) << " "
               << fixed(enlarged * plot.fitted[i].x, 3) << " "
               << fixed(enlarged * plot.fitted[i].y, 3) << "\n";
    gnuplot.endData();
    auto& out = gnuplot.script();
    out << "set multiplot layout 1,2 margins 0.05,0.98,0.1,0.92 spacing 0.07\n"
        << kFrame << "set size ratio -1\nset xlabel 'du [px]'\nset ylabel 'dv [px]'\n"
        << "set xrange [-" << fixed(half, 6) << ":" << fixed(half, 6) << "]\nset yrange ["
        << fixed(half, 6) << ":-" << fixed(half, 6) << "]\nset xzeroaxis\nset yzeroaxis\n"
        << "set title 'seen minus expected'\nplot ";
    if (!plot.heldOut.empty())
        out << "$heldout using 1:2 with points pt 6 ps 0.8 lc rgb '#e07b00' title 'held out', ";
    out << "$fitted using 1:2 with points pt 7 ps 0.5 lc rgb '#1f5fd0' title 'fitted'\n"
        << "unset xzeroaxis\nunset yzeroaxis\nset xlabel 'u [px]'\nset ylabel 'v [px]'\n"
        << "set xrange [0:" << plot.size.width << "]\nset yrange [" << plot.size.height
        << ":0]\nset title 'fitted, " << fixed(enlarged, 0)
        << " times enlarged, where they were seen'\n"
        << "plot $arrows using 1:2:3:4 with vectors head size screen 0.005,20 filled lw 1 lc rgb "
           "'#1f5fd0' "
           "notitle\nunset multiplot\n";
    gnuplot.run(file);
}

void plotDistances(const std::vector<TBoardDistances>& boards, const std::string& file) {
    viz::CGnuplot gnuplot(1600, 800);
    bool anyHeldOut = false;
    double largest = 1e-4;
    for (const bool heldOut : {false, true}) {
        auto& out = gnuplot.data(heldOut ? "heldout" : "fitted");
        for (std::size_t i = 0; i < boards.size(); ++i)
            for (const double d : heldOut ? boards[i].heldOut : boards[i].fitted) {
                out << i + 1 << " " << fixed(1e3 * d, 4) << "\n";
                anyHeldOut = anyHeldOut || heldOut;
                largest = std::max(largest, std::abs(d));
            }
        gnuplot.endData();
    }
    const double half = 1.05e3 * largest;
    auto& out = gnuplot.script();
    out << "set multiplot layout 1,2 margins 0.06,0.98,0.1,0.92 spacing 0.07\n"
        << kFrame
        << "set xzeroaxis\nset xlabel 'board'\nset ylabel 'distance from the board [mm]'\n"
        << "set yrange [-" << fixed(half, 3) << ":" << fixed(half, 3)
        << "]\nset xrange [0:" << boards.size() + 1
        << "]\nset title 'ends of beams, board by board'\nplot ";
    if (anyHeldOut)
        out << "$heldout using ($1+0.15):2 with points pt 6 ps 0.5 lc rgb '#e07b00' title 'held "
               "out', ";
    out << "$fitted using ($1-0.15):2 with points pt 7 ps 0.35 lc rgb '#1f5fd0' title 'fitted'\n";
    const double width = half / 25;
    out << "bin(x) = " << fixed(width, 6) << "*(floor(x/" << fixed(width, 6) << ")+0.5)\n"
        << "unset xzeroaxis\nset xlabel 'distance from the board [mm]'\nset ylabel 'beams'\n"
        << "set xrange [-" << fixed(half, 3) << ":" << fixed(half, 3)
        << "]\nset yrange [0:*]\nset title 'median distance "
        << fixed(1e3 * medianAbsolute(boards, &TBoardDistances::fitted), 1) << " mm fitted";
    if (anyHeldOut)
        out << ", " << fixed(1e3 * medianAbsolute(boards, &TBoardDistances::heldOut), 1)
            << " mm held out";
    out << "'\nplot $fitted using (bin($2)):(1) smooth frequency with steps lw 2 lc rgb '#1f5fd0' "
           "title 'fitted'";
    if (anyHeldOut)
        out << ", $heldout using (bin($2)):(1) smooth frequency with steps lw 2 lc rgb '#e07b00' "
               "title 'held out'";
    out << "\nunset multiplot\n";
    gnuplot.run(file);
}

}  // namespace salma::apps
