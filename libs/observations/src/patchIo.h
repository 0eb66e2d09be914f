// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/serialization/CArchive.h>
#include <salma/observations/TPatch.h>
#include <salma/observations/TPlaceString.h>

namespace salma::observations::io {

// Layout of version 0 of CObservationSalientLandmarks; a later version gets functions of its own.
void writePatch(mrpt::serialization::CArchive& out, const TPatch& patch);
TPatch readPatch(mrpt::serialization::CArchive& in);
void writePlace(mrpt::serialization::CArchive& out, const TPlaceString& place);
TPlaceString readPlace(mrpt::serialization::CArchive& in);

/// Writes how many elements follow; throws std::length_error for more than the reader takes.
void writeCount(mrpt::serialization::CArchive& out, std::size_t count, std::size_t limit);

constexpr std::size_t kMaxLandmarks = 10'000;  //!< In a picture.
constexpr std::size_t kMaxElements = 100'000;  //!< Regions, keypoints, bins or letters.

}  // namespace salma::observations::io
