// SPDX-License-Identifier: BSD-3-Clause
#include <salma/viz/CGnuplot.h>
#include <salma/viz/CPlots.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "CTextFile.h"

namespace salma::viz {
namespace {

using slam::TRunRecord;

/// One innovation in its place on the axis.
struct TSample {
    double time{0};        //!< [s since 1970]
    double x{0};           //!< [s since the start], or its number.
    double value{0};       //!< In the component's unit.
    double bound{0};       //!< 2 sigma, in the component's unit.
    bool afterGap{false};  //!< The robot saw nothing known just before.

    bool inside() const { return std::abs(value) <= bound; }
};
using Samples = std::vector<TSample>;

/// Time; or, for logs whose stamps do not tell the steps apart, the number of the sighting.
struct TAxis {
    bool isTime{true};
    double start{0}, length{1};
};

TAxis axisOf(const TRunRecord& record) {
    const auto& rows = record.trajectory;
    if (rows.empty()) return {};
    std::size_t distinct = 1;
    for (std::size_t i = 1; i < rows.size(); ++i) distinct += rows[i].time > rows[i - 1].time;
    TAxis axis{2 * distinct > rows.size(), rows.front().time, rows.back().time - rows.front().time};
    if (!axis.isTime) axis.length = static_cast<double>(record.innovations.size()) / 2;
    axis.length = std::max(1e-3, axis.length);
    return axis;
}

/// Longest step on the axis that counts as seeing without a break: one and a half of the usual.
double usualStep(const Samples& samples) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < samples.size(); ++i)
        if (samples[i].x > samples[i - 1].x) steps.push_back(samples[i].x - samples[i - 1].x);
    if (steps.empty()) return 0;
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return 1.5 * *middle;
}

/// True if the robot took a step between the two times [s].
bool stepsBetween(const TRunRecord& record, double from, double to) {
    const auto next = std::upper_bound(record.trajectory.begin(), record.trajectory.end(), from,
                                       [](double t, const auto& row) { return t < row.time; });
    return next == record.trajectory.end() || next->time < to;
}

/// Innovations of one component in their order in time.
Samples samplesOf(const TRunRecord& record, const std::string& component, const TAxis& axis) {
    Samples samples;
    for (const auto& row : record.innovations) {
        if (row.component != component || !std::isfinite(row.value)) continue;
        const double x = axis.isTime ? row.time - axis.start : static_cast<double>(samples.size());
        samples.push_back({row.time, x, row.value, 2 * row.sigma});
    }
    if (!axis.isTime) return samples;
    const double usual = usualStep(samples);
    for (std::size_t i = 1; i < samples.size(); ++i)
        samples[i].afterGap = samples[i].x - samples[i - 1].x > usual &&
                              stepsBetween(record, samples[i - 1].time, samples[i].time);
    return samples;
}

std::string insideShare(const Samples& samples) {
    const auto inside =
        std::count_if(samples.begin(), samples.end(), [](const auto& s) { return s.inside(); });
    const double share = 100 * static_cast<double>(inside) / static_cast<double>(samples.size());
    return fixed(share, 1) + " % of " + std::to_string(samples.size());
}

/// Place and largest bound of each step; empty lines break the curve. A step alone between two gaps
/// becomes a short bar.
void writeBounds(std::ostream& out, const Samples& samples, const TAxis& axis) {
    const double half = axis.length / 600;
    for (std::size_t i = 0; i < samples.size();) {
        const std::size_t first = i;
        double bound = 0;
        for (; i < samples.size() && samples[i].x == samples[first].x; ++i)
            bound = std::max(bound, samples[i].bound);
        const bool opens = first == 0 || samples[first].afterGap;
        const bool closes = i == samples.size() || samples[i].afterGap;
        const double x = samples[first].x;
        if (first > 0 && opens) out << "\n";
        if (opens && closes) out << number(x - half) << " " << number(bound) << "\n";
        out << number(opens && closes ? x + half : x) << " " << number(bound) << "\n";
    }
}

void writeValues(std::ostream& out, const Samples& samples) {
    for (const auto& s : samples)
        out << (s.afterGap ? "\n" : "") << number(s.x) << " " << number(s.value) << " "
            << (s.inside() ? "1" : "0") << "\n";
}

struct TPanel {
    std::string component, name, unit;
};

/// Half of a y range that the wildest 2 % of bounds and values cannot flatten.
double halfHeight(const Samples& samples) {
    std::vector<double> sizes;
    for (const auto& s : samples) sizes.push_back(std::max(std::abs(s.value), s.bound));
    std::sort(sizes.begin(), sizes.end());
    if (sizes.empty()) return 1;
    const double usual = 1.6 * sizes[(sizes.size() - 1) * 98 / 100];
    return std::max(1e-9, std::min(1.15 * sizes.back(), usual));
}

void drawPanel(CGnuplot& plot, const TRunRecord& record, const TPanel& panel) {
    const TAxis axis = axisOf(record);
    const Samples samples = samplesOf(record, panel.component, axis);
    auto& out = plot.script();
    const double height = halfHeight(samples);
    out << "set ylabel '" << panel.name << " innovation [" << panel.unit << "]'\n"
        << "set yrange [" << number(-height) << ":" << number(height) << "]\n";
    if (samples.empty()) {
        out << "set title '" << panel.name << ": no landmark was seen again'\nplot NaN notitle\n";
        return;
    }
    writeBounds(plot.data("bounds_" + panel.component), samples, axis);
    plot.endData();
    writeValues(plot.data("values_" + panel.component), samples);
    plot.endData();
    const std::string bounds = "$bounds_" + panel.component, values = "$values_" + panel.component;
    out << "set title '" << panel.name << ": " << insideShare(samples)
        << " inside their own 2 sigma bounds (95.4 % expected)'\n"
        << "plot " << bounds << " using 1:2 with lines lw 2 lc rgb '#d62728' title "
        << "'+/- 2 sigma (largest of the step)', " << bounds
        << " using 1:(-$2) with lines lw 2 lc rgb '#d62728' notitle, " << values
        << " using 1:2 with lines lw 1 lc rgb '#9cbcf0' notitle, " << values
        << " using 1:($3 == 1 ? $2 : NaN) with points pt 7 ps 0.5 lc rgb '#1f5fd0' title "
           "'innovation', "
        << values
        << " using 1:($3 == 0 ? $2 : NaN) with points pt 6 ps 0.9 lw 1.5 lc rgb '#e07b00' title "
           "'outside its own bounds'\n";
}

}  // namespace

void plotInnovations(const TRunRecord& record, const std::string& file) {
    CGnuplot plot(1600, 1000);
    const TAxis axis = axisOf(record);
    plot.script() << "set datafile missing NaN\nset multiplot layout 2,1 "
                  << "margins screen 0.07,0.98,0.13,0.95 spacing screen 0.09\n"
                  << "set xrange [0:" << number(axis.length) << "]\n"
                  << "set grid lc rgb '#e6e6e6' lt 1 lw 1\nset border lw 1.2 lc rgb '#606060'\n"
                  << "set tics textcolor rgb '#303030'\n"
                  << "set xzeroaxis lt 1 lw 1 lc rgb '#808080'\nunset key\n";
    drawPanel(plot, record, {"range_m", "Range", "m"});
    plot.script() << "set xlabel '"
                  << (axis.isTime ? "time since the start [s]" : "number of the sighting")
                  << "'\nset key at screen 0.52,0.035 center "
                  << "horizontal Left reverse samplen 2 width 2\n";
    drawPanel(plot, record, {"bearing_deg", "Bearing", "deg"});
    plot.script() << "unset multiplot\n";
    plot.run(file);
}

}  // namespace salma::viz
