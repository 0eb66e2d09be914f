// SPDX-License-Identifier: BSD-3-Clause
// The first byte says in what pieces the rest comes. With a checksum put right now and then, since
// a fuzzer seldom guesses one.
#include <salma/drivers/CSickParser.h>

#include <algorithm>
#include <cstdlib>

using salma::drivers::CSickParser;
using salma::drivers::ESickReply;

namespace {

void require(bool good) {
    if (!good) std::abort();
}

/// Where the bytes look like a telegram, their checksum becomes the right one.
void putRight(std::vector<std::uint8_t>& bytes) {
    for (std::size_t at = 0; at + 6 < bytes.size(); ++at) {
        if (bytes[at] != 0x02 || bytes[at + 1] != 0x80) continue;
        const std::size_t end = at + 4 + bytes[at + 2] + 256U * bytes[at + 3];
        if (end + 2 > bytes.size()) continue;
        const auto sum = salma::drivers::sickChecksum(bytes.data() + at, end - at);
        bytes[end] = static_cast<std::uint8_t>(sum & 0xFF);
        bytes[end + 1] = static_cast<std::uint8_t>(sum >> 8);
        at = end + 1;
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    std::vector<std::uint8_t> bytes(data + 1, data + size);
    if (data[0] & 0x80) putRight(bytes);
    const std::size_t piece = 1 + data[0] % 64;
    CSickParser parser;
    std::size_t used = 0;
    for (std::size_t at = 0; at < bytes.size(); at += piece)
        for (const auto& reply :
             parser.push(bytes.data() + at, std::min(piece, bytes.size() - at), 1, 1e-3)) {
            used += reply.bytes.size();
            require(reply.bytes.size() <= CSickParser::maxTelegram && reply.began <= 1);
            require((reply.kind == ESickReply::telegram) == (reply.bytes.size() > 6));
        }
    parser.reset();
    require(used + parser.counts().strayBytes == bytes.size());
    return 0;
}
