// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/simulator/CSimulator.h>

namespace salma::simulator {

/// T_w_r at one instant.
struct TTruePose {
    double stamp;  //!< [s since 1970]
    mrpt::math::TPose2D pose;
};

/// Each \throw std::runtime_error if the file cannot be written.
void writeTrajectory(const std::filesystem::path& file, const std::vector<TTruePose>& poses);
void writeLandmarks(const std::filesystem::path& file, const std::vector<TTrueLandmark>& landmarks);
void writeSightings(const std::filesystem::path& file, const std::vector<TSighting>& sightings);

/// In order of their stamps, gzipped as MRPT does.
void writeRawlog(const std::filesystem::path& file,
                 std::vector<mrpt::obs::CObservation::Ptr> records);

}  // namespace salma::simulator
