// SPDX-License-Identifier: BSD-3-Clause
// The first byte says in what pieces the rest comes.
#include <salma/drivers/CSentenceParser.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

using salma::drivers::CSentenceParser;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::size_t piece = 1 + data[0] % 64;
    CSentenceParser parser;
    for (std::size_t at = 1; at < size; at += piece)
        for (const auto& sentence : parser.push(data + at, std::min(piece, size - at), 1, 1e-4)) {
            bool good = !sentence.name.empty() && sentence.began <= 1;
            for (const double value : sentence.values) good = good && std::isfinite(value);
            if (!good) std::abort();
        }
    return 0;
}
