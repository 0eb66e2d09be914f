// SPDX-License-Identifier: BSD-3-Clause
#include "stringFigures.h"

#include <mrpt/core/bits_math.h>
#include <salma/laser/CLineExtractor.h>
#include <salma/laser/CPlaceDistance.h>
#include <salma/laser/CPlaceString.h>
#include <salma/simulator/CLaserModel.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <random>
#include <string>
#include <vector>

#include "TPlaceSample.h"

namespace salma::bench {
namespace {

using mrpt::math::TPose2D;
using observations::TPlaceString;

constexpr std::size_t kSteps = 600, kFirst = 20, kEvery = 60;  // of a walk
constexpr std::size_t kOthers = 7;                             // places before, of any building

struct TRow {
    std::string what;
    double move, turn;  // [m], [rad]
    std::vector<double> distances;
};

void write(TRow row, std::ostream& out) {
    auto& d = row.distances;
    std::sort(d.begin(), d.end());
    out << "| " << row.what << " | " << d.size();
    for (const std::size_t tenths : {1, 5, 9}) out << " | " << d[d.size() * tenths / 10];
    out << " |\n";
}

}  // namespace

void writeStringFigures(const simulator::TBuildingOptions& options,
                        std::uint32_t seed,
                        int buildings,
                        std::ostream& out) {
    const laser::CLineExtractor lines;
    const laser::CPlaceString reader;
    const laser::CPlaceDistance distance;
    std::vector<TRow> rows{{"same pose, other noise", 0, 0, {}}};
    for (const int cm : {5, 10, 20, 40})
        rows.push_back({std::to_string(cm) + " cm beside", cm * 0.01, 0, {}});
    for (const int deg : {5, 10, 20, 30})
        rows.push_back(
            {"turned by " + std::to_string(deg) + " deg", 0, mrpt::DEG2RAD(1.0 * deg), {}});
    TRow others{"one of the " + std::to_string(kOthers) + " other places before it", 0, 0, {}};
    std::vector<TPlaceString> before;
    std::mt19937 random(seed);
    for (std::uint32_t s = seed; s < seed + static_cast<std::uint32_t>(buildings); ++s) {
        const simulator::CBuilding building(options, s);
        const simulator::CLaserModel laser(placeLaser(), building.segments(), s);
        std::uint64_t scans = 0;
        const auto stringAt = [&](const TPose2D& pose) {
            const auto scan = laser.scan(pose, scans++);
            return reader.describe(scan, lines.extract(scan));
        };
        const auto walk = wander(building, s, kSteps);
        for (std::size_t i = kFirst; i < walk.size(); i += kEvery) {
            const TPlaceString here = stringAt(walk[i]);
            for (TRow& row : rows) {
                const double way = 2 * M_PI * static_cast<double>(random()) / 0x1p32;
                const TPose2D there(walk[i].x + row.move * std::cos(way),
                                    walk[i].y + row.move * std::sin(way), walk[i].phi + row.turn);
                row.distances.push_back(distance(here, stringAt(there)));
            }
            for (std::size_t k = before.size() - std::min(before.size(), kOthers);
                 k < before.size(); ++k)
                others.distances.push_back(distance(here, before[k]));
            before.push_back(here);
        }
    }
    out << "| second scan | pairs | 10 % | median | 90 % |\n|---|---:|---:|---:|---:|\n"
        << std::fixed << std::setprecision(3);
    for (const TRow& row : rows) write(row, out);
    write(others, out);
    out << std::defaultfloat;
}

}  // namespace salma::bench
