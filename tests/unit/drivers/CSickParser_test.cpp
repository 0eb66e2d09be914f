// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/drivers/CSickParser.h>

#include <algorithm>
#include <random>

using namespace salma::drivers;

namespace {

using TBytes = std::vector<std::uint8_t>;

std::vector<TSickReply> parse(CSickParser& parser, const TBytes& bytes) {
    return parser.push(bytes.data(), bytes.size());
}

TBytes telegram(const TBytes& content) {
    TBytes bytes(content.size() + 6);
    bytes[0] = 0x02;
    bytes[1] = 0x80;
    bytes[2] = static_cast<std::uint8_t>(content.size() & 0xFF);
    bytes[3] = static_cast<std::uint8_t>(content.size() >> 8);
    std::copy(content.begin(), content.end(), bytes.begin() + 4);
    const auto sum = sickChecksum(bytes.data(), bytes.size() - 2);
    bytes[bytes.size() - 2] = static_cast<std::uint8_t>(sum & 0xFF);
    bytes[bytes.size() - 1] = static_cast<std::uint8_t>(sum >> 8);
    return bytes;
}

/// A scan of n beams whose ranges hold every byte, 02, 06 and 80 among them.
TBytes scan(std::size_t n) {
    TBytes content{0xB0, static_cast<std::uint8_t>(n & 0xFF), static_cast<std::uint8_t>(n >> 8)};
    for (std::size_t i = 0; i < 2 * n; ++i) content.push_back(static_cast<std::uint8_t>(i * 7));
    content.push_back(0x10);
    return telegram(content);
}

const TBytes kModeChanged{0x02, 0x80, 0x03, 0x00, 0xA0, 0x00, 0x10, 0x16, 0x0A};

TBytes joined(const std::vector<TBytes>& parts) {
    TBytes all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace

/// Commands and a reply with the checksums that SICK's list of telegrams prints.
TEST(CSickParser, CountsTheChecksumAsTheMakerDoes) {
    for (const TBytes& bytes : {TBytes{0x02, 0x00, 0x02, 0x00, 0x20, 0x24, 0x34, 0x08},
                                TBytes{0x02, 0x00, 0x02, 0x00, 0x20, 0x25, 0x35, 0x08},
                                TBytes{0x02, 0x00, 0x02, 0x00, 0x20, 0x42, 0x52, 0x08},
                                TBytes{0x02, 0x00, 0x01, 0x00, 0x31, 0x15, 0x12},
                                TBytes{0x02, 0x00, 0x0A, 0x00, 0x20, 0x00, 0x53, 0x49, 0x43, 0x4B,
                                       0x5F, 0x4C, 0x4D, 0x53, 0xBE, 0xC5},
                                kModeChanged}) {
        const std::size_t n = bytes.size();
        EXPECT_EQ(sickChecksum(bytes.data(), n - 2), bytes[n - 2] + 256 * bytes[n - 1]);
    }
}

TEST(CSickParser, KnowsEveryReply) {
    CSickParser parser;
    const auto replies = parse(parser, joined({{0x06}, kModeChanged, {0x15}, scan(361)}));
    ASSERT_EQ(replies.size(), 4U);
    EXPECT_EQ(replies[0].kind, ESickReply::acknowledge);
    EXPECT_EQ(replies[0].command(), 0);
    EXPECT_EQ(replies[1].kind, ESickReply::telegram);
    EXPECT_EQ(replies[1].command(), 0xA0);
    EXPECT_EQ(replies[1].bytes, kModeChanged);
    EXPECT_EQ(replies[2].kind, ESickReply::refusal);
    EXPECT_EQ(replies[3].command(), 0xB0);
    EXPECT_EQ(replies[3].bytes.size(), 732U);
    EXPECT_EQ(parser.counts().strayBytes, 0U);
}

TEST(CSickParser, PiecesOfAnySizeGiveTheSameReplies) {
    const TBytes all = joined({scan(181), {0x06}, kModeChanged, scan(101)});
    CSickParser parser;
    std::size_t replies = 0;
    for (const auto byte : all) replies += parser.push(&byte, 1).size();
    EXPECT_EQ(replies, 4U);
}

TEST(CSickParser, AReplyKeepsTheTimeOfItsFirstByte) {
    CSickParser parser;
    const TBytes bytes = joined({kModeChanged, kModeChanged});
    // The last of 18 bytes came at 10 s, each took 0.1 s.
    const auto replies = parser.push(bytes.data(), bytes.size(), 10, 0.1);
    ASSERT_EQ(replies.size(), 2U);
    EXPECT_NEAR(replies[0].began, 10 - 1.7, 1e-12);
    EXPECT_NEAR(replies[1].began, 10 - 0.8, 1e-12);
}

TEST(CSickParser, ATelegramThatBreaksOffDoesNotTakeTheNextWithIt) {
    CSickParser parser;
    TBytes cut = scan(361);
    cut.resize(300);
    const auto replies = parse(parser, joined({cut, scan(181), scan(181), scan(181)}));
    const auto scans = std::count_if(replies.begin(), replies.end(),
                                     [](const auto& reply) { return reply.command() == 0xB0; });
    EXPECT_EQ(scans, 3);
    EXPECT_GE(parser.counts().badTelegrams, 1U);
}

TEST(CSickParser, AWrongChecksumCostsOneTelegram) {
    CSickParser parser;
    TBytes wrong = kModeChanged;
    wrong[5] ^= 1;
    const auto replies = parse(parser, joined({wrong, kModeChanged}));
    ASSERT_EQ(replies.size(), 1U);
    EXPECT_EQ(replies[0].bytes, kModeChanged);
    EXPECT_EQ(parser.counts().badTelegrams, 1U);
    EXPECT_EQ(parser.counts().strayBytes, kModeChanged.size());
}

TEST(CSickParser, LengthsThatCannotBeAreRefusedAtOnce) {
    CSickParser parser;
    for (const TBytes& head : {TBytes{0x02, 0x80, 0xFF, 0xFF}, TBytes{0x02, 0x80, 0x00, 0x00},
                               TBytes{0x02, 0x80, 0x1B, 0x03}})  // 801 bytes in all
        EXPECT_EQ(parse(parser, joined({head, kModeChanged})).size(), 1U);
    EXPECT_EQ(parser.counts().badTelegrams, 3U);
    // The longest: 794 bytes of content.
    EXPECT_EQ(parse(parser, telegram(TBytes(794, 0x01))).size(), 1U);
}

TEST(CSickParser, ResetForgetsATelegramThatHasBegun) {
    CSickParser parser;
    parse(parser, {0x02, 0x80, 0x03, 0x00, 0xA0});
    parser.reset();
    EXPECT_EQ(parse(parser, kModeChanged).size(), 1U);
    EXPECT_EQ(parser.counts().strayBytes, 5U);
}

namespace {

/// Replies with one to six bytes changed, taken out or put in, as `random` wills.
TBytes mutated(std::mt19937& random) {
    const auto below = [&random](std::size_t n) {
        return static_cast<std::ptrdiff_t>(random() % n);
    };
    const std::vector<TBytes> kinds{{0x06}, {0x15}, kModeChanged, scan(3), scan(20), scan(101)};
    TBytes bytes;
    for (int n = 0; n < 6; ++n) {
        const auto& part = kinds[static_cast<std::size_t>(below(kinds.size()))];
        bytes.insert(bytes.end(), part.begin(), part.end());
    }
    for (auto n = 1 + below(6); n > 0 && !bytes.empty(); --n) {
        const auto at = bytes.begin() + below(bytes.size());
        const std::uint8_t special[] = {0x02, 0x80, 0xFF, 0x06};
        const auto value =
            below(2) == 0 ? special[random() % 4] : static_cast<std::uint8_t>(random());
        if (below(3) == 0)
            bytes.erase(at);
        else if (below(2) == 0)
            bytes.insert(at, value);
        else
            *at = value;
    }
    return bytes;
}

}  // namespace

TEST(CSickParser, CorruptedBytesNeverConfuseItForLong) {
    std::mt19937 random(20042);
    std::size_t bytes = 0, used = 0;
    CSickParser parser;
    const auto count = [&](const std::vector<TSickReply>& replies) {
        for (const auto& reply : replies) {
            used += reply.bytes.size();
            if (reply.kind != ESickReply::telegram) continue;
            const std::size_t n = reply.bytes.size();
            ASSERT_LE(n, CSickParser::maxTelegram);
            EXPECT_EQ(reply.bytes[2] + 256U * reply.bytes[3] + 6, n);
            EXPECT_EQ(sickChecksum(reply.bytes.data(), n - 2),
                      reply.bytes[n - 2] + 256 * reply.bytes[n - 1]);
        }
    };
    for (int run = 0; run < 5000; ++run) {
        const TBytes input = mutated(random);
        bytes += input.size();
        for (std::size_t at = 0; at < input.size();) {  // in pieces, as a port delivers them
            const std::size_t piece = std::min<std::size_t>(1 + random() % 60, input.size() - at);
            count(parser.push(input.data() + at, piece));
            at += piece;
        }
        // Whatever came before: after as many bytes as a telegram has, the next is understood.
        const TBytes good = joined({TBytes(CSickParser::maxTelegram, 0xFF), kModeChanged});
        bytes += good.size();
        const auto replies = parse(parser, good);
        count(replies);
        ASSERT_FALSE(replies.empty());
        EXPECT_EQ(replies.back().bytes, kModeChanged);
    }
    EXPECT_EQ(used + parser.counts().strayBytes, bytes);  // every byte is accounted for
}
