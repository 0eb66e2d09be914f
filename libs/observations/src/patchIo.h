// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/serialization/CArchive.h>
#include <salma/observations/TPatch.h>
#include <salma/observations/TPlaceString.h>

namespace salma::observations::io {

void writePatch(mrpt::serialization::CArchive& out, const TPatch& patch);

/** \param version Of CObservationSalientLandmarks. Version 0 held regions in pixels of the source
 * picture; they are carried over to metres on the patch by its four corners. Where the corners are
 * no quadrilateral, the regions are dropped: nothing compared them then. */
TPatch readPatch(mrpt::serialization::CArchive& in, std::uint8_t version);

void writePlace(mrpt::serialization::CArchive& out, const TPlaceString& place);
TPlaceString readPlace(mrpt::serialization::CArchive& in);

/// Writes how many elements follow; throws std::length_error for more than the reader takes.
void writeCount(mrpt::serialization::CArchive& out, std::size_t count, std::size_t limit);

constexpr std::size_t kMaxLandmarks = 10'000;  //!< In a picture.
constexpr std::size_t kMaxElements = 100'000;  //!< Regions, keypoints, bins or letters.

}  // namespace salma::observations::io
