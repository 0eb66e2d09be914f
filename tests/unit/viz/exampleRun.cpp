// SPDX-License-Identifier: BSD-3-Clause
#include "exampleRun.h"

#include <cmath>
#include <random>

namespace salma::test {
namespace {

using association::ELandmarkKind;
using mrpt::poses::CPose2D;
using slam::EDecision;
using slam::ESight;

constexpr double kStart = 1.1e9, kLap = 60, kSpeed = 0.4;

/// Pose after `s` metres along the middle of the hallway, counter-clockwise from a corner.
CPose2D onLoop(double s) {
    s = std::fmod(s, kLap);
    if (s < 20) return {s, 0, 0};
    if (s < 30) return {20, s - 20, M_PI / 2};
    if (s < 50) return {20 - (s - 30), 10, M_PI};
    return {0, 10 - (s - 50), -M_PI / 2};
}

void addWalls(slam::TRunRecord& record, std::mt19937& random) {
    std::normal_distribution<double> noise(0, 0.015);
    const auto box = [&](double x0, double y0, double x1, double y1) {
        for (double f = 0; f < 1; f += 0.002) {
            record.scanPoints.emplace_back(x0 + f * (x1 - x0), y0 + noise(random));
            record.scanPoints.emplace_back(x0 + f * (x1 - x0), y1 + noise(random));
            record.scanPoints.emplace_back(x0 + noise(random), y0 + f * (y1 - y0));
            record.scanPoints.emplace_back(x1 + noise(random), y0 + f * (y1 - y0));
        }
    };
    box(-1.2, -1.2, 21.2, 11.2);
    box(1.2, 1.2, 18.8, 8.8);
}

slam::TMapLandmark cornerAt(double x, double y) {
    slam::TMapLandmark corner;
    corner.mean = {x, y};
    corner.firstMean = {x + 0.05, y - 0.04};
    corner.covariance << 0.004, 0.001, 0.001, 0.006;
    corner.firstCovariance << 0.02, 0.008, 0.008, 0.03;
    corner.sightings = 12;
    return corner;
}

void addLandmarks(slam::TRunRecord& record) {
    for (const double x : {-1.2, 21.2})
        for (const double y : {-1.2, 11.2}) record.landmarks.push_back(cornerAt(x, y));
    for (double x = 2.5; x < 18; x += 2.5)
        for (const double y : {1.2, 8.8}) record.landmarks.push_back(cornerAt(x, y));
    record.landmarks.push_back(posterAt(5, -1.2, M_PI / 2));
    record.landmarks.push_back(posterAt(13, -1.2, M_PI / 2));
    record.landmarks.push_back(posterAt(21.2, 4, M_PI));
    record.landmarks.push_back(posterAt(15, 11.2, -M_PI / 2));
    record.landmarks.push_back(posterAt(6, 11.2, -M_PI / 2));
    record.landmarks.push_back(posterAt(-1.2, 5, 0));
    for (std::size_t i = 0; i < record.landmarks.size(); ++i) {
        auto& landmark = record.landmarks[i];
        landmark.id = static_cast<int>(i);
        landmark.firstTime = kStart + 2.5 * static_cast<double>(i);
        landmark.lastTime = kStart + 150 + landmark.id;
    }
}

ESight sightAt(double s) {
    if (std::fmod(s, 10) > 4) return ESight::nothing;
    return s < kLap ? ESight::first : ESight::again;
}

void addInnovations(slam::TRunRecord& record, double time, std::mt19937& random) {
    std::normal_distribution<double> unit(0, 1);
    for (int i = 0; i < 2; ++i) {
        const double sigma = 0.05 + 0.03 * std::sin(0.05 * (time - kStart));
        record.innovations.push_back({time, "range_m", sigma * unit(random), sigma});
        record.innovations.push_back({time, "bearing_deg", 20 * sigma * unit(random), 20 * sigma});
    }
}

void addAssociations(slam::TRunRecord& record, double time, double s) {
    const double nan = std::nan("");
    const bool known = s >= kLap;
    slam::TAssociationRow row{time, 0, ELandmarkKind::salient, 2.5, 0.3, 310.5, 200.25};
    row.decision = known ? EDecision::paired : EDecision::created;
    row.landmark = 18;
    row.distance2 = known ? 1.5 : nan;
    row.logRatio = known ? 12.25 : nan;
    row.candidates = known ? 1 : 0;
    record.associations.push_back(row);
    record.associations.push_back({time, 1, ELandmarkKind::corner, 3, -0.5, nan, nan, nan,
                                   EDecision::deferred, -1, nan, nan, 2});
    record.candidates.push_back({time, 1, 4, 2.5, nan, false});
}

}  // namespace

slam::TMapLandmark posterAt(double x, double y, double wallAngle) {
    auto patch = std::make_shared<observations::TPatch>();
    patch->pose.mean = mrpt::poses::CPose3D(1, 1.2, 1.5, 0, 0, 0);
    patch->width = 0.6;
    patch->height = 0.4;
    patch->pixelsPerMetre = 100;
    patch->picture.resize(60, 40, mrpt::img::CH_GRAY);
    patch->picture.filledRectangle(0, 0, 59, 39, mrpt::img::TColor(255, 255, 255));
    patch->picture.filledRectangle(0, 0, 29, 19, mrpt::img::TColor(0, 0, 0));
    slam::TMapLandmark poster = {};
    poster.kind = ELandmarkKind::salient;
    poster.mean = {x, y};
    poster.covariance << 0.0025, 0, 0, 0.0016;
    poster.firstMean = {x + 0.06, y + 0.08};
    poster.firstCovariance << 0.04, 0.01, 0.01, 0.02;
    poster.sightings = 9;
    poster.patch = patch;
    poster.wallAngle = wallAngle;
    return poster;
}

TExampleRun hallwayRun() {
    TExampleRun run;
    auto& record = run.record;
    std::mt19937 random(7);
    addWalls(record, random);
    addLandmarks(record);
    double sigma = 0.02;
    for (double s = 0; s < 2 * kLap + 3; s += 0.2) {
        const double time = kStart + s / kSpeed;
        const CPose2D truth = onLoop(s);
        slam::TTrajectoryRow row;
        row.time = time;
        row.sight = sightAt(s);
        if (row.sight == ESight::nothing) sigma += 0.003;
        if (row.sight == ESight::again) sigma = std::max(0.03, 0.7 * sigma);
        row.pose = CPose2D(truth.x() + 0.08 * std::sin(0.3 * s),
                           truth.y() + 0.06 * std::cos(0.4 * s), truth.phi());
        row.covariance << sigma * sigma, 0, 0, 0, 0.4 * sigma * sigma, 0, 0, 0, 1e-4;
        const double drift = 0.0025 * s;
        row.odometry = CPose2D(0, 0, drift) + truth;
        record.trajectory.push_back(row);
        run.truth.push_back({time, CPose2D(1, 0, 0) + truth});
        if (row.sight == ESight::again) addInnovations(record, time, random);
        if (row.sight != ESight::nothing) addAssociations(record, time, s);
    }
    record.notices = {"no pan/tilt in the log: the camera is taken as fixed"};
    record.pictures = 300;
    record.picturesWithoutLandmark = 120;
    record.seconds = 42.5;
    record.seed = 7;
    record.logFile = "rawlogs/hallway & <loop>.rawlog";
    record.options = "[association]\nmethod = saliency  // <one> of \"nn\" & others\n";
    return run;
}

}  // namespace salma::test
