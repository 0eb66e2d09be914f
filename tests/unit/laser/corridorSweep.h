// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <zlib.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace salma::laser::test {

/** The 3D scans of a real corridor as scans of a nodding laser in its own place.
 *
 * The file has points in cm (x right, y up, z forward), 360 for each scan, from right to left in
 * steps of 0.5 deg from -90 deg; 3276 cm mean no return.
 * \throw std::runtime_error if the file is not so. */
inline std::vector<mrpt::obs::CObservation2DRangeScan> readCorridorSweep(const std::string& file) {
    constexpr std::size_t kReadings = 360;
    constexpr double kDegree = M_PI / 180;
    const std::unique_ptr<gzFile_s, int (*)(gzFile)> stream(gzopen(file.c_str(), "rb"), gzclose);
    if (!stream) throw std::runtime_error(file + ": cannot be read");
    std::vector<mrpt::obs::CObservation2DRangeScan> scans;
    char line[256];
    for (std::size_t i = 0; gzgets(stream.get(), line, sizeof line);) {
        double x = 0, y = 0, z = 0;
        if (std::sscanf(line, "%lf %lf %lf", &x, &y, &z) != 3) continue;
        if (i == 0) {
            scans.emplace_back();
            scans.back().aperture = static_cast<float>((kReadings - 1) * 0.5 * kDegree);
            scans.back().maxRange = 32;
            scans.back().resizeScan(kReadings);
        }
        auto& scan = scans.back();
        const double range = std::sqrt(x * x + y * y + z * z) / 100;
        scan.setScanRange(i, static_cast<float>(range));
        scan.setScanRangeValidity(i, range > 0 && range < 32);
        if (i == kReadings / 2)  // straight ahead
            scan.sensorPose = mrpt::poses::CPose3D(0, 0, 0, 0, -std::atan2(y, z), 0) +
                              mrpt::poses::CPose3D(0, 0, 0, -0.25 * kDegree, 0, 0);
        i = (i + 1) % kReadings;
    }
    if (scans.size() < 2) throw std::runtime_error(file + ": holds no sweep");
    return scans;
}

}  // namespace salma::laser::test
