// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/serialization/CSerializable.h>
#include <salma/observations/CObservationPanTilt.h>
#include <salma/observations/CObservationSalientLandmarks.h>

#include <string>
#include <vector>

namespace salma::test {

using TObjects = std::vector<mrpt::serialization::CSerializable::Ptr>;

/// A record with two landmarks (the second without picture, keypoints and texture) in which no two
/// numbers are alike.
observations::CObservationSalientLandmarks::Ptr exampleRecord();
/// Expects every field of exampleRecord(), each written down by hand.
void expectExample(const observations::CObservationSalientLandmarks& record);

observations::CObservationPanTilt::Ptr examplePanTilt();
void expectExample(const observations::CObservationPanTilt& state);

/// Objects as the bytes of a plain rawlog.
std::string bytesOf(const TObjects& objects);
/// Bytes as gzip packs them.
std::string packed(const std::string& bytes);
/// The only object of a plain rawlog; throws what the reader throws.
mrpt::serialization::CSerializable::Ptr objectOf(const std::string& bytes);

}  // namespace salma::test
