// SPDX-License-Identifier: BSD-3-Clause
#include <salma/viz/CPlots.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "CGnuplot.h"
#include "CTextFile.h"

namespace salma::viz {
namespace {

using slam::TInnovationRow;
using slam::TRunRecord;

/// Innovations of one component in their order in time.
using Samples = std::vector<const TInnovationRow*>;

Samples samplesOf(const TRunRecord& record, const std::string& component) {
    Samples samples;
    for (const auto& row : record.innovations)
        if (row.component == component && std::isfinite(row.value)) samples.push_back(&row);
    return samples;
}

/// Longest time between two stamps that counts as seeing without a break: one and a half of the
/// usual.
double usualStep(const Samples& samples) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < samples.size(); ++i)
        if (samples[i]->time > samples[i - 1]->time)
            steps.push_back(samples[i]->time - samples[i - 1]->time);
    if (steps.empty()) return 0;
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return 1.5 * *middle;
}

/// True if the robot took a step between the two stamps [s] and saw nothing known then.
bool isGap(const TRunRecord& record, double from, double to, double usual) {
    if (!(to - from > usual)) return false;
    const auto next = std::upper_bound(record.trajectory.begin(), record.trajectory.end(), from,
                                       [](double t, const auto& row) { return t < row.time; });
    return next == record.trajectory.end() || next->time < to;
}

std::string insideShare(const Samples& samples) {
    const auto inside = std::count_if(samples.begin(), samples.end(), [](const auto* s) {
        return std::abs(s->value) <= 2 * s->sigma;
    });
    const double share = 100 * static_cast<double>(inside) /
                         static_cast<double>(std::max<std::size_t>(1, samples.size()));
    return fixed(share, 1) + " % of " + std::to_string(samples.size());
}

/// Time [s since the start], largest 2 sigma of each stamp; empty lines break the curve.
void writeBounds(CGnuplot& plot, const TRunRecord& record, const Samples& samples, double start) {
    const double usual = usualStep(samples);
    for (std::size_t i = 0; i < samples.size();) {
        if (i > 0 && isGap(record, samples[i - 1]->time, samples[i]->time, usual))
            plot.script() << "\n";
        const double time = samples[i]->time;
        double bound = 0;
        for (; i < samples.size() && samples[i]->time == time; ++i)
            bound = std::max(bound, 2 * samples[i]->sigma);
        plot.script() << number(time - start) << " " << number(bound) << "\n";
    }
}

void writeValues(CGnuplot& plot, const TRunRecord& record, const Samples& samples, double start) {
    const double usual = usualStep(samples);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const auto& s = *samples[i];
        if (i > 0 && isGap(record, samples[i - 1]->time, s.time, usual)) plot.script() << "\n";
        plot.script() << number(s.time - start) << " " << number(s.value) << " "
                      << (std::abs(s.value) <= 2 * s.sigma ? "1" : "0") << "\n";
    }
}

struct TPanel {
    std::string component, name, unit;
};

/// A y range that one wild sample cannot flatten: 1.3 times the 98 % quantile of bounds and values.
double halfHeight(const Samples& samples) {
    std::vector<double> sizes;
    for (const auto* s : samples) sizes.push_back(std::max(std::abs(s->value), 2 * s->sigma));
    std::sort(sizes.begin(), sizes.end());
    if (sizes.empty()) return 1;
    const double largest = sizes.back();
    const double usual = 1.6 * sizes[(sizes.size() - 1) * 98 / 100];
    return std::max(1e-9, std::min(1.15 * largest, usual));
}

void drawPanel(CGnuplot& plot, const TRunRecord& record, const TPanel& panel, double start) {
    const Samples samples = samplesOf(record, panel.component);
    auto& out = plot.script();
    const double height = halfHeight(samples);
    out << "unset label\nset ylabel '" << panel.name << " innovation [" << panel.unit << "]'\n"
        << "set yrange [" << number(-height) << ":" << number(height) << "]\n";
    if (samples.empty()) {
        out << "set title '" << panel.name << ": no landmark was seen again'\nplot NaN notitle\n";
        return;
    }
    plot.data("bounds_" + panel.component);
    writeBounds(plot, record, samples, start);
    plot.endData();
    plot.data("values_" + panel.component);
    writeValues(plot, record, samples, start);
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
    const double start = record.trajectory.empty() ? 0 : record.trajectory.front().time;
    const double end = record.trajectory.empty() ? 1 : record.trajectory.back().time;
    plot.script() << "set datafile missing NaN\nset multiplot layout 2,1 "
                  << "margins screen 0.07,0.98,0.13,0.95 spacing screen 0.09\n"
                  << "set xrange [0:" << number(std::max(1e-3, end - start)) << "]\n"
                  << "set grid lc rgb '#e6e6e6' lt 1 lw 1\nset border lw 1.2 lc rgb '#606060'\n"
                  << "set tics textcolor rgb '#303030'\n"
                  << "set xzeroaxis lt 1 lw 1 lc rgb '#808080'\nunset key\n";
    drawPanel(plot, record, {"range_m", "Range", "m"}, start);
    plot.script() << "set xlabel 'time since the start [s]'\nset key at screen 0.52,0.035 center "
                  << "horizontal Left reverse samplen 2 width 2\n";
    drawPanel(plot, record, {"bearing_deg", "Bearing", "deg"}, start);
    plot.script() << "unset multiplot\n";
    plot.run(file);
}

}  // namespace salma::viz
