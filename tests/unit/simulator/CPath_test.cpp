// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>
#include <salma/simulator/CPath.h>

#include <cmath>

namespace salma::simulator {
namespace {

TPathOptions square() {  // sides of 10 m; counter-clockwise
    TPathOptions options;
    options.points = {0, 0, 5, 0, 5, 10, -5, 10, -5, 0};
    options.laps = 1;
    options.cornerRadius = 1;
    options.wander = 0;
    return options;
}

TEST(CPath, ALapIsTheSquareWithFourQuarterCirclesForItsCorners) {
    EXPECT_NEAR(CPath(square()).lapLength(), 40 - 4 * 2 + 2 * M_PI, 1e-9);
}

TEST(CPath, EndsWhereItStartedAndFacesAhead) {
    TPathOptions options = square();
    options.laps = 2;
    const CPath path(options);
    const auto start = path.pose(0), end = path.pose(path.duration());
    EXPECT_NEAR(start.x, 0, 1e-9);
    EXPECT_NEAR(start.phi, 0, 1e-9);
    EXPECT_NEAR(std::hypot(end.x - start.x, end.y - start.y), 0, 0.03);  // last step of the plan
    EXPECT_NEAR(path.firstLapEnd(), path.duration() / 2, 2);
}

TEST(CPath, CutsACornerByAnArcThatTouchesBothSides) {
    const CPath path(square());
    double nearest = 10;  // distance to the arc's middle, (4 + sin 45, 1 - cos 45)
    for (double t = 0; t < path.duration(); t += 0.01) {
        const auto p = path.pose(t);
        nearest =
            std::min(nearest, std::hypot(p.x - (4 + std::sqrt(0.5)), p.y - (1 - std::sqrt(0.5))));
    }
    EXPECT_LT(nearest, 0.005);
}

TEST(CPath, KeepsToItsSpeedTurnRateAndAcceleration) {
    TPathOptions options = square();
    options.cornerRadius = 0.5;  // 0.5 m/s would turn at 57 deg/s
    const CPath path(options);
    constexpr double h = 0.02;
    double fastest = 0, lastSpeed = 0;
    for (double t = h; t < path.duration() - h; t += h) {
        const auto a = path.pose(t - h / 2), b = path.pose(t + h / 2);
        const double speed = std::hypot(b.x - a.x, b.y - a.y) / h;
        EXPECT_LE(std::abs(mrpt::math::wrapToPi(b.phi - a.phi)) / h, options.turnRate * 1.05);
        EXPECT_LE(std::abs(speed - lastSpeed) / h, options.acceleration * 1.3) << t;
        fastest = std::max(fastest, speed);
        lastSpeed = speed;
    }
    EXPECT_NEAR(fastest, 0.5, 1e-3);
}

TEST(CPath, FacesTheWayItMovesWhileItSways) {
    TPathOptions options = square();
    options.wander = 0.1;
    const CPath path(options, 3);
    double farthest = 0;
    for (double t = 2; t < path.duration() - 2; t += 0.1) {
        const auto a = path.pose(t - 0.005), b = path.pose(t + 0.005), p = path.pose(t);
        EXPECT_NEAR(mrpt::math::wrapToPi(std::atan2(b.y - a.y, b.x - a.x) - p.phi), 0, 0.01) << t;
        if (p.x > 0 && p.x < 4 && p.y < 1) farthest = std::max(farthest, std::abs(p.y));
    }
    EXPECT_GT(farthest, 0.02);
    EXPECT_LE(farthest, 0.1 + 1e-9);
}

}  // namespace
}  // namespace salma::simulator
