// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace salma::apps {

/// "YUYV" for V4L2_PIX_FMT_YUYV; what cannot be printed as a dot.
std::string nameOfPixelFormat(std::uint32_t fourcc);
/// \throw std::invalid_argument unless `name` has four characters, or fewer, which blanks follow.
std::uint32_t pixelFormatOf(const std::string& name);

/// "progressive", "interlaced", "upper fields", ...
std::string nameOfField(std::uint32_t field);

/// Set of broadcast standards by the name of a family (PAL, NTSC, SECAM) or of a member (PAL-BG,
/// NTSC-M,
/// ...), in any case. \throw std::invalid_argument listing the names.
std::uint64_t standardOf(const std::string& name);
/// Names of the families or members that `set` holds whole; "none" for 0.
std::string nameOfStandard(std::uint64_t set);

}  // namespace salma::apps
