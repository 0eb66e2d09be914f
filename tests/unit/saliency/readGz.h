// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <zlib.h>

#include <array>
#include <stdexcept>
#include <string>

namespace salma::saliency::test {

/// Whole text of a gzip file.
inline std::string readGz(const std::string& file) {
    gzFile in = gzopen(file.c_str(), "rb");
    if (in == nullptr) throw std::runtime_error("cannot read " + file);
    std::string text;
    std::array<char, 65536> buffer{};
    for (int n = 0; (n = gzread(in, buffer.data(), buffer.size())) > 0;)
        text.append(buffer.data(), static_cast<std::size_t>(n));
    gzclose(in);
    return text;
}

}  // namespace salma::saliency::test
