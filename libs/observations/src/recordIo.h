// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/CImage.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/serialization/CArchive.h>

#include <cstdint>
#include <string>
#include <vector>

namespace salma::observations::io {

/* Reading of records that does not trust the file: MRPT's own operators allocate whatever a count
 * says and take a short read for a whole one. All throw std::runtime_error with one line. */

/// Fills `data`, or throws where the stream ends first.
void readBytes(mrpt::serialization::CArchive& in, void* data, std::size_t bytes);

/// A number as MRPT stores it (little endian).
template <class NUMBER>
NUMBER readNumber(mrpt::serialization::CArchive& in) {
    NUMBER value{};
    if (in.ReadBufferFixEndianness(&value, 1) != sizeof value)
        throw std::runtime_error("record breaks off");
    return value;
}

/// A count of `what`; a count above `limit` is an error.
std::size_t readCount(mrpt::serialization::CArchive& in, std::size_t limit, const char* what);

/// A finite number named `what`; NaN and infinity are errors.
double readFinite(mrpt::serialization::CArchive& in, const char* what);

/// Text as MRPT stores it, of at most 4096 bytes.
std::string readText(mrpt::serialization::CArchive& in, const char* what);

/// Writes what readText() reads; throws std::length_error for text that it would refuse.
void writeText(mrpt::serialization::CArchive& out, const std::string& text);

/// x, y, z, yaw, pitch, roll [m, rad].
void writePose(mrpt::serialization::CArchive& out, const mrpt::poses::CPose3D& pose);
mrpt::poses::CPose3D readPose(mrpt::serialization::CArchive& in);

/** A grey picture: columns, rows, then the pixels row by row without padding, one byte each. The
 * rawlog is compressed as a whole, which does as well here as a picture format.
 * \throw std::invalid_argument for a colour picture. */
void writeGrey(mrpt::serialization::CArchive& out, const mrpt::img::CImage& picture);
mrpt::img::CImage readGrey(mrpt::serialization::CArchive& in);

}  // namespace salma::observations::io
