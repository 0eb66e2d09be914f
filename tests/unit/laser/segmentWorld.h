// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose2D.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace salma::laser::test {

struct TSegment {
    mrpt::math::TPoint2D a, b;
};

using TWorld = std::vector<TSegment>;

struct TScanner {
    std::size_t beams{361};
    double aperture{M_PI};
    double sigma{0};         //!< Of a range [m].
    double quantum{0};       //!< Ranges are rounded to this [m]; 0: not at all.
    double bearingSigma{0};  //!< [rad]
};

struct THit {
    double range{0};         //!< [m]; 0: nothing met.
    std::size_t segment{0};  //!< Index into the world.
};

/// The first segment that a ray meets.
inline THit castRay(const TWorld& world, const mrpt::poses::CPose2D& ray) {
    THit nearest;
    const double c = std::cos(ray.phi());
    const double s = std::sin(ray.phi());
    for (std::size_t i = 0; i < world.size(); ++i) {
        const TSegment& w = world[i];
        const mrpt::math::TPoint2D e = w.b - w.a;
        const double det = e.x * s - e.y * c;
        if (std::abs(det) < 1e-12) continue;
        const double px = w.a.x - ray.x();
        const double py = w.a.y - ray.y();
        const double range = (e.x * py - e.y * px) / det;
        const double along = (c * py - s * px) / det;
        if (range > 0 && along >= 0 && along <= 1 && (nearest.range == 0 || range < nearest.range))
            nearest = {range, i};
    }
    return nearest;
}

/// Scan of a scanner that stands at `pose` in the world and at the robot's origin.
inline mrpt::obs::CObservation2DRangeScan castScan(const TWorld& world,
                                                   const mrpt::poses::CPose2D& pose,
                                                   const TScanner& scanner,
                                                   std::mt19937& random) {
    std::normal_distribution<double> normal;
    mrpt::obs::CObservation2DRangeScan scan;
    scan.aperture = static_cast<float>(scanner.aperture);
    scan.maxRange = 80;
    scan.stdError = static_cast<float>(scanner.sigma);
    scan.resizeScan(scanner.beams);
    for (std::size_t i = 0; i < scanner.beams; ++i) {
        const double bearing =
            -0.5 * scan.aperture +
            static_cast<double>(i) * scan.aperture / static_cast<double>(scanner.beams - 1) +
            scanner.bearingSigma * normal(random);
        const mrpt::poses::CPose2D ray(pose.x(), pose.y(), pose.phi() + bearing);
        double range = castRay(world, ray).range;
        const bool hit = range > 0;
        range += scanner.sigma * normal(random);
        if (scanner.quantum > 0) range = std::round(range / scanner.quantum) * scanner.quantum;
        scan.setScanRange(i, hit ? static_cast<float>(std::max(range, 0.0)) : 0.0F);
        scan.setScanRangeValidity(i, hit);
    }
    return scan;
}

/// A closed polygon.
inline TWorld polygon(const std::vector<mrpt::math::TPoint2D>& corners) {
    TWorld world;
    for (std::size_t i = 0; i < corners.size(); ++i)
        world.push_back({corners[i], corners[(i + 1) % corners.size()]});
    return world;
}

/// A corridor along x, 2 m wide, closed at x = -10 and x = 10, with door recesses of 0.9 x 0.12 m
/// at every 2.5 m of its left wall (y = 1), and a plain right wall.
inline std::vector<mrpt::math::TPoint2D> corridorOutline() {
    std::vector<mrpt::math::TPoint2D> p{{-10, -1}, {10, -1}, {10, 1}};
    for (double x = 7.5; x > -9; x -= 2.5) {
        p.push_back({x + 0.45, 1});
        p.push_back({x + 0.45, 1.12});
        p.push_back({x - 0.45, 1.12});
        p.push_back({x - 0.45, 1});
    }
    p.push_back({-10, 1});
    return p;
}

}  // namespace salma::laser::test
