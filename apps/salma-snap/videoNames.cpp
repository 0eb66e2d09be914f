// SPDX-License-Identifier: BSD-3-Clause
#include "videoNames.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>

namespace salma::apps {
namespace {

struct TStandard {
    const char* name;
    std::uint64_t set;
};

// Families first: a set that holds all of PAL is called PAL.
constexpr std::array<TStandard, 14> kStandards = {{{"PAL", V4L2_STD_PAL},
                                                   {"NTSC", V4L2_STD_NTSC},
                                                   {"SECAM", V4L2_STD_SECAM},
                                                   {"PAL-BG", V4L2_STD_PAL_BG},
                                                   {"PAL-DK", V4L2_STD_PAL_DK},
                                                   {"PAL-I", V4L2_STD_PAL_I},
                                                   {"PAL-H", V4L2_STD_PAL_H},
                                                   {"PAL-M", V4L2_STD_PAL_M},
                                                   {"PAL-N", V4L2_STD_PAL_N},
                                                   {"PAL-60", V4L2_STD_PAL_60},
                                                   {"NTSC-M", V4L2_STD_NTSC_M},
                                                   {"NTSC-M-JP", V4L2_STD_NTSC_M_JP},
                                                   {"NTSC-M-KR", V4L2_STD_NTSC_M_KR},
                                                   {"NTSC-443", V4L2_STD_NTSC_443}}};

}  // namespace

std::string nameOfPixelFormat(std::uint32_t fourcc) {
    std::string name;
    for (int i = 0; i < 4; ++i) {
        const auto c = static_cast<unsigned char>((fourcc >> (8 * i)) & 0x7F);
        name += std::isprint(c) != 0 ? static_cast<char>(c) : '.';
    }
    while (!name.empty() && name.back() == ' ') name.pop_back();
    return name;
}

std::uint32_t pixelFormatOf(const std::string& name) {
    if (name.empty() || name.size() > 4)
        throw std::invalid_argument("pixel format '" + name +
                                    "' is not a four-character code such as YUYV");
    std::string padded = name;
    padded.resize(4, ' ');
    return v4l2_fourcc(static_cast<unsigned char>(padded[0]), static_cast<unsigned char>(padded[1]),
                       static_cast<unsigned char>(padded[2]),
                       static_cast<unsigned char>(padded[3]));
}

std::string nameOfField(std::uint32_t field) {
    switch (field) {
        case V4L2_FIELD_NONE:
            return "progressive";
        case V4L2_FIELD_TOP:
            return "upper fields";
        case V4L2_FIELD_BOTTOM:
            return "lower fields";
        case V4L2_FIELD_INTERLACED:
        case V4L2_FIELD_INTERLACED_TB:
        case V4L2_FIELD_INTERLACED_BT:
            return "interlaced";
        case V4L2_FIELD_ALTERNATE:
            return "alternating fields";
        case V4L2_FIELD_SEQ_TB:
        case V4L2_FIELD_SEQ_BT:
            return "one field below the other";
        default:
            return "fields unknown";
    }
}

std::uint64_t standardOf(const std::string& name) {
    std::string upper = name, all;
    std::transform(upper.begin(), upper.end(), upper.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    for (const auto& standard : kStandards) {
        if (upper == standard.name) return standard.set;
        all += std::string(" ") + standard.name;
    }
    throw std::invalid_argument("standard '" + name + "' is not one of:" + all);
}

std::string nameOfStandard(std::uint64_t set) {
    std::string names;
    for (const auto& standard : kStandards) {
        if ((set & standard.set) != standard.set) continue;
        names += (names.empty() ? "" : " ") + std::string(standard.name);
        set &= ~standard.set;
    }
    return names.empty() ? (set == 0 ? "none" : "unknown") : names;
}

}  // namespace salma::apps
