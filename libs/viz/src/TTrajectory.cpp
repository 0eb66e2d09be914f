// SPDX-License-Identifier: BSD-3-Clause
#include <salma/viz/TTrajectory.h>

#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "CTextFile.h"

namespace salma::viz {
namespace {

using TumNumbers = std::array<double, 8>;

[[noreturn]] void fail(const std::string& file, std::size_t line, const std::string& problem) {
    throw std::invalid_argument(file + ":" + std::to_string(line) + ": " + problem);
}

/// \throw std::invalid_argument with the problem alone
TumNumbers parseLine(const std::string& line) {
    std::istringstream words(line);
    TumNumbers numbers{};
    std::size_t count = 0;
    for (std::string word; words >> word; ++count) {
        if (count == numbers.size()) throw std::invalid_argument("holds more than 8 numbers");
        double& value = numbers[count];
        if (!parseNumber(word, value) || !std::isfinite(value))
            throw std::invalid_argument("'" + word + "' is not a finite number");
    }
    if (count < numbers.size())
        throw std::invalid_argument("holds " + std::to_string(count) + " of the 8 numbers " +
                                    "t x y z qx qy qz qw");
    return numbers;
}

TStampedPose asPose(const TumNumbers& n) {
    const auto [t, x, y, z, qx, qy, qz, qw] = n;
    static_cast<void>(z);
    const double norm2 = qx * qx + qy * qy + qz * qz + qw * qw;
    if (!(std::abs(std::sqrt(norm2) - 1) <= 0.01))
        throw std::invalid_argument("the quaternion has not length 1");
    const double yaw =
        std::atan2(2 * (qw * qz + qx * qy), norm2 - 2 * (qy * qy + qz * qz));  // any length
    return {t, mrpt::poses::CPose2D(x, y, yaw)};
}

}  // namespace

TTrajectory readTum(const std::string& file) {
    std::istringstream in(readText(file));
    TTrajectory trajectory;
    std::string text;
    for (std::size_t line = 1; std::getline(in, text); ++line) {
        const auto first = text.find_first_not_of(" \t\r");
        if (first == std::string::npos || text[first] == '#') continue;
        try {
            trajectory.push_back(asPose(parseLine(text)));
        } catch (const std::invalid_argument& e) {
            fail(file, line, e.what());
        }
        const std::size_t n = trajectory.size();
        if (n > 1 && trajectory[n - 1].time < trajectory[n - 2].time)
            fail(file, line, "the stamp is smaller than the one before");
    }
    if (trajectory.empty()) throw std::invalid_argument(file + ": holds no pose");
    return trajectory;
}

void writeTum(const TTrajectory& trajectory, const std::string& file) {
    std::vector<TStampedSpatialPose> spatial;
    for (const auto& [time, pose] : trajectory)
        spatial.push_back({time, mrpt::poses::CPose3D(pose)});
    writeTum(spatial, file);
}

void writeTum(const std::vector<TStampedSpatialPose>& trajectory, const std::string& file) {
    CTextFile text(file);
    for (const auto& [time, pose] : trajectory) {
        mrpt::math::CQuaternionDouble q;
        pose.getAsQuaternion(q);
        text.out() << stamp(time);
        for (const double value : {pose.x(), pose.y(), pose.z(), q.x(), q.y(), q.z(), q.r()})
            text.out() << ' ' << number(value);
        text.out() << '\n';
    }
    text.close();
}

}  // namespace salma::viz
