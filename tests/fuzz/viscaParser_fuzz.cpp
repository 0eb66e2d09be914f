// SPDX-License-Identifier: BSD-3-Clause
// The first byte says in what pieces the rest comes.
#include <salma/drivers/CViscaParser.h>

#include <algorithm>
#include <cstdlib>

using salma::drivers::CViscaParser;
using salma::drivers::EViscaReply;

namespace {

void require(bool good) {
    if (!good) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::size_t piece = 1 + data[0] % 16;
    CViscaParser parser;
    std::size_t replies = 0;
    for (std::size_t at = 1; at < size; at += piece)
        for (const auto& reply : parser.push(data + at, std::min(piece, size - at), 1)) {
            ++replies;
            require(reply.kind == EViscaReply::addressSet
                        ? reply.data.size() == 1
                        : reply.address >= 1 && reply.address <= 7);
            require(reply.socket >= 0 && reply.socket <= 15 && reply.data.size() <= 13);
        }
    require(parser.counts().replies == replies && parser.counts().strayBytes + 3 * replies <= size);
    return 0;
}
