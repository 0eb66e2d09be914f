// SPDX-License-Identifier: BSD-3-Clause
#include "realStrip.h"

#include <mrpt/math/wrap2pi.h>
#include <mrpt/poses/CPose3D.h>
#include <salma/laser/CPlaceClassifier.h>
#include <salma/laser/CPlaceFilter.h>
#include <salma/observations/readCarmenLog.h>
#include <salma/viz/CGnuplot.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace salma::bench {
namespace {

using laser::EPlaceClass;
using laser::kPlaceClasses;
using laser::mostLikely;
using mrpt::poses::CPose2D;

constexpr double kTurning = M_PI / 12;  // in one step
constexpr double kShown = 12;           // points farther away are not drawn [m]
constexpr double kArrow = 0.8;          // [m]

constexpr std::array<const char*, kPlaceClasses> kColours{
    "#555555", "#1f78b4", "#33a02c", "#e31a1c", "#17becf",
    "#bcbd22", "#ff7f00", "#e377c2", "#d4a017", "#6a3d9a"};

struct TJudged {
    CPose2D pose;
    EPlaceClass place;
};

std::vector<TJudged> judge(const std::vector<observations::TCarmenScan>& scans,
                           std::size_t& notJudged) {
    const laser::CPlaceClassifier classifier;
    laser::CPlaceFilter filter;
    std::vector<TJudged> judged;
    CPose2D before;
    for (const auto& scan : scans) {
        const double turn = mrpt::math::wrapToPi(scan.odometry.phi() - before.phi());
        const auto step = !judged.empty() && std::abs(turn) > kTurning ? laser::EPlaceStep::turning
                                                                       : laser::EPlaceStep::goingOn;
        const auto p = classifier.classify(*scan.scan);
        if (!p) ++notJudged;
        judged.push_back(
            {scan.odometry, mostLikely(p ? filter.update(*p, step) : filter.skip(step))});
        before = scan.odometry;
    }
    return judged;
}

void writePoints(const observations::TCarmenScan& scan, std::ostream& data) {
    const auto& s = *scan.scan;
    const CPose2D T_w_l = scan.odometry + CPose2D(s.sensorPose);
    const double step = s.aperture / static_cast<double>(s.getScanSize() - 1);
    for (std::size_t i = 0; i < s.getScanSize(); ++i) {
        const double r = s.getScanRange(i);
        if (!s.getScanRangeValidity(i) || r > kShown) continue;
        const double bearing = T_w_l.phi() - s.aperture / 2 + static_cast<double>(i) * step;
        data << T_w_l.x() + r * std::cos(bearing) << ' ' << T_w_l.y() + r * std::sin(bearing)
             << '\n';
    }
}

}  // namespace

void drawStrip(const TStrip& strip, std::ostream& out) {
    const auto log = observations::readCarmenLog(strip.log);
    const auto first = std::min(static_cast<std::size_t>(strip.first), log.scans.size());
    const std::size_t rest = log.scans.size() - first;
    const std::size_t count =
        strip.count > 0 ? std::min(rest, static_cast<std::size_t>(strip.count)) : rest;
    if (count == 0) throw std::runtime_error(strip.log + ": no scan in that strip");
    const std::vector<observations::TCarmenScan> scans(
        log.scans.begin() + static_cast<long>(first),
        log.scans.begin() + static_cast<long>(first + count));
    std::size_t notJudged = 0;
    const auto judged = judge(scans, notJudged);

    viz::CGnuplot plot(1500, 480);
    auto& points = plot.data("points");
    for (const auto& scan : scans) writePoints(scan, points);
    plot.endData();
    std::string command = "plot $points using 2:(-$1) with dots lc '#bbbbbb' notitle";
    out << count << " scans of " << strip.log << ", " << notJudged << " not judged\n";
    for (std::size_t c = 0; c < kPlaceClasses; ++c) {
        const std::string name = "class" + std::to_string(c);
        auto& data = plot.data(name);
        std::size_t n = 0;
        for (const TJudged& j : judged) {
            if (j.place != static_cast<EPlaceClass>(c)) continue;
            ++n;
            data << j.pose.x() << ' ' << j.pose.y() << ' ' << kArrow * std::cos(j.pose.phi()) << ' '
                 << kArrow * std::sin(j.pose.phi()) << '\n';
        }
        plot.endData();
        out << asString(static_cast<EPlaceClass>(c)) << ": " << n << '\n';
        if (n > 0)
            command += ", $" + name +
                       " using 2:(-$1):4:(-$3) with vectors head size 0.25,25 filled lw 1.6 " +
                       "lc '" + kColours[c] + "' title '" + asString(static_cast<EPlaceClass>(c)) +
                       "'";
    }
    plot.script()
        << "set size ratio -1\nset key outside top center horizontal\nset xlabel 'y [m]'\n"
           "set ylabel '-x [m]'\n"
        << command << '\n';
    plot.run(strip.picture);
}

}  // namespace salma::bench
