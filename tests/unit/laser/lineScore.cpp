// SPDX-License-Identifier: BSD-3-Clause
#include "lineScore.h"

#include <mrpt/math/wrap2pi.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace salma::laser::test {
namespace {

constexpr double kSameWall = 1e-6;      // collinear pieces differ by less [m], [rad]
constexpr double kEndTolerance = 0.03;  // of a line's ends to the wall [m]

struct TPlane {
    double rho, alpha;
};

TPlane planeOf(const TTrueWall& wall) {
    const mrpt::math::TPoint2D d = wall.b - wall.a;
    double c = d.y / d.norm(), s = -d.x / d.norm();
    double rho = wall.a.x * c + wall.a.y * s;
    if (rho < 0) {
        rho = -rho;
        c = -c;
        s = -s;
    }
    return {rho, std::atan2(s, c)};
}

bool same(const TPlane& a, const TPlane& b) {
    return std::abs(a.rho - b.rho) < kSameWall &&
           std::abs(mrpt::math::wrapToPi(a.alpha - b.alpha)) < kSameWall;
}

/// Where a beam meets a wall's line, measured along it [m].
double meets(const TPlane& plane, const mrpt::poses::CPose3D& sensor, double bearing) {
    const double heading = sensor.yaw() + bearing;
    const double dx = std::cos(heading), dy = std::sin(heading);
    const double c = std::cos(plane.alpha), s = std::sin(plane.alpha);
    const double range = (plane.rho - sensor.x() * c - sensor.y() * s) / (dx * c + dy * s);
    return (sensor.y() + range * dy) * c - (sensor.x() + range * dx) * s;
}

double bearingOf(const mrpt::obs::CObservation2DRangeScan& scan, std::size_t i) {
    const auto last = static_cast<double>(scan.getScanSize() - 1);
    return scan.aperture * (static_cast<double>(i) / last - 0.5);
}

double distance(const TTrueLine& wall, const mrpt::math::TPoint2D& p) {
    return std::abs(p.x * std::cos(wall.alpha) + p.y * std::sin(wall.alpha) - wall.rho);
}

std::size_t common(const TLine& line, const TTrueLine& wall) {
    const auto first = std::lower_bound(wall.beams.begin(), wall.beams.end(), line.firstPoint);
    const auto last = std::upper_bound(first, wall.beams.end(), line.lastPoint);
    return static_cast<std::size_t>(last - first);
}

bool fits(const TLine& line, const TTrueLine& wall) {
    const std::size_t both = common(line, wall);
    return 2 * both >= line.points && 2 * both >= wall.beams.size() &&
           distance(wall, line.from) <= kEndTolerance && distance(wall, line.to) <= kEndTolerance;
}

double squaredError(const TLine& line, const TTrueLine& wall) {
    const bool flipped = std::cos(line.alpha - wall.alpha) < 0;
    const Eigen::Vector2d error(
        line.rho - (flipped ? -wall.rho : wall.rho),
        mrpt::math::wrapToPi(line.alpha - wall.alpha - (flipped ? M_PI : 0.0)));
    return error.dot(line.covariance.ldlt().solve(error));
}

struct TPair {
    std::size_t common, line, wall;
};

}  // namespace

std::vector<TTrueLine> trueLines(const std::vector<TTrueWall>& walls,
                                 const std::vector<int>& hits,
                                 const mrpt::obs::CObservation2DRangeScan& scan,
                                 const TLineOptions& options) {
    std::vector<TTrueLine> lines;
    std::vector<double> ends;  // of each line so far, along it
    for (std::size_t i = 0; i < hits.size(); ++i) {
        if (hits[i] < 0) continue;
        const TPlane plane = planeOf(walls[static_cast<std::size_t>(hits[i])]);
        const double at = meets(plane, scan.sensorPose, bearingOf(scan, i));
        std::size_t k = lines.size();
        for (std::size_t j = lines.size(); j-- > 0;)
            if (same({lines[j].rho, lines[j].alpha}, plane)) {
                const bool neighbours = lines[j].beams.back() + 1 == i;
                if (neighbours || std::abs(at - ends[j]) <= options.gap) k = j;
                break;
            }
        if (k == lines.size()) {
            lines.push_back({plane.rho, plane.alpha, {}, 0});
            ends.push_back(at);
        }
        lines[k].beams.push_back(i);
        lines[k].length += std::abs(at - ends[k]);
        ends[k] = at;
    }
    return lines;
}

void addScore(const TLineResult& result,
              const std::vector<TTrueLine>& truth,
              const TRequired& required,
              TLineScore& score) {
    std::vector<TPair> pairs;
    for (std::size_t i = 0; i < result.lines.size(); ++i)
        for (std::size_t j = 0; j < truth.size(); ++j)
            if (fits(result.lines[i], truth[j]))
                pairs.push_back({common(result.lines[i], truth[j]), i, j});
    std::sort(pairs.begin(), pairs.end(), [](const TPair& a, const TPair& b) {
        return a.common != b.common ? a.common > b.common
                                    : std::pair(a.line, a.wall) < std::pair(b.line, b.wall);
    });
    const auto isRequired = [&](std::size_t points, double length) {
        return points >= required.points && length >= required.length;
    };
    constexpr int kNone = -1;
    std::vector<int> wallOf(result.lines.size(), kNone);
    std::vector<char> found(truth.size(), 0);
    for (const TPair& pair : pairs) {
        if (wallOf[pair.line] != kNone || found[pair.wall]) continue;
        wallOf[pair.line] = static_cast<int>(pair.wall);
        found[pair.wall] = 1;
        score.nees += squaredError(result.lines[pair.line], truth[pair.wall]);
        ++score.compared;
    }
    ++score.scans;
    for (std::size_t j = 0; j < truth.size(); ++j) {
        if (!isRequired(truth[j].beams.size(), truth[j].length)) continue;
        ++score.required;
        score.found += found[j];
        score.lines += found[j];
    }
    for (std::size_t i = 0; i < result.lines.size(); ++i) {
        const TLine& line = result.lines[i];
        if (wallOf[i] != kNone || !isRequired(line.points, line.length())) continue;
        ++score.lines;
        ++score.wrong;
    }
}

}  // namespace salma::laser::test
