// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/drivers/CViscaParser.h>

#include <random>

using namespace salma::drivers;

namespace {

using TBytes = std::vector<std::uint8_t>;

std::vector<TViscaReply> parse(CViscaParser& parser, const TBytes& bytes, double time = 0) {
    return parser.push(bytes.data(), bytes.size(), time);
}

/// One of each reply, as a camera sends them.
const std::vector<TBytes> kReplies = {
    {0x88, 0x30, 0x02, 0xFF},
    {0x90, 0x50, 0xFF},
    {0x90, 0x41, 0xFF},
    {0x90, 0x51, 0xFF},
    {0x90, 0x60, 0x02, 0xFF},
    {0x90, 0x62, 0x41, 0xFF},
    {0x90, 0x38, 0xFF},
    {0x90, 0x50, 0x0F, 0x0C, 0x0A, 0x04, 0x00, 0x01, 0x01, 0x0E, 0xFF},
    {0xF0, 0x50, 0x00, 0x03, 0x0F, 0x0F, 0xFF}};

TBytes joined(const std::vector<TBytes>& packets) {
    TBytes all;
    for (const auto& packet : packets) all.insert(all.end(), packet.begin(), packet.end());
    return all;
}

}  // namespace

TEST(CViscaParser, KnowsEveryReply) {
    CViscaParser parser;
    const auto replies = parse(parser, joined(kReplies));
    ASSERT_EQ(replies.size(), kReplies.size());
    EXPECT_EQ(replies[0].kind, EViscaReply::addressSet);
    EXPECT_EQ(replies[0].data, TBytes{2});
    EXPECT_EQ(replies[1].kind, EViscaReply::completion);
    EXPECT_EQ(replies[1].socket, 0);
    EXPECT_EQ(replies[2].kind, EViscaReply::acknowledge);
    EXPECT_EQ(replies[2].socket, 1);
    EXPECT_EQ(replies[2].address, 1);
    EXPECT_EQ(replies[3].kind, EViscaReply::completion);
    EXPECT_EQ(replies[4].kind, EViscaReply::error);
    EXPECT_EQ(replies[4].error, 0x02);
    EXPECT_EQ(replies[5].error, 0x41);
    EXPECT_EQ(replies[5].socket, 2);
    EXPECT_EQ(replies[6].kind, EViscaReply::networkChange);
    EXPECT_EQ(replies[7].kind, EViscaReply::information);
    EXPECT_EQ(replies[7].data.size(), 8U);
    EXPECT_EQ(replies[8].address, 7);
    EXPECT_EQ(parser.counts().replies, kReplies.size());
    EXPECT_EQ(parser.counts().strayBytes, 0U);
}

TEST(CViscaParser, PiecesOfAnySizeGiveTheSameReplies) {
    const TBytes all = joined(kReplies);
    CViscaParser parser;
    std::size_t replies = 0;
    for (const auto byte : all) replies += parser.push(&byte, 1).size();
    EXPECT_EQ(replies, kReplies.size());
}

TEST(CViscaParser, AReplyKeepsTheTimeOfItsFirstByte) {
    CViscaParser parser;
    EXPECT_TRUE(parse(parser, {0x12, 0x90}, 5).empty());
    EXPECT_TRUE(parse(parser, {0x41}, 6).empty());
    const auto replies = parse(parser, {0xFF, 0x90, 0x51, 0xFF}, 7);
    ASSERT_EQ(replies.size(), 2U);
    EXPECT_EQ(replies[0].began, 5);
    EXPECT_EQ(replies[1].began, 7);
}

TEST(CViscaParser, ALostEndCostsOnePacketOnly) {
    CViscaParser parser;
    const auto replies = parse(parser, {0x90, 0x50, 0x00, 0x01, 0x90, 0x51, 0xFF});
    ASSERT_EQ(replies.size(), 1U);
    EXPECT_EQ(replies[0].kind, EViscaReply::completion);
    EXPECT_EQ(parser.counts().badPackets, 1U);
    EXPECT_EQ(parser.counts().strayBytes, 4U);
}

TEST(CViscaParser, NoiseBetweenPacketsIsSkipped) {
    CViscaParser parser;
    const auto replies = parse(parser, {0x00, 0x7F, 0xFF, 0xFF, 0x13, 0x90, 0x41, 0xFF, 0x55});
    ASSERT_EQ(replies.size(), 1U);
    EXPECT_EQ(replies[0].socket, 1);
    EXPECT_EQ(parser.counts().strayBytes, 6U);
    EXPECT_EQ(parser.counts().badPackets, 0U);
}

TEST(CViscaParser, WhatHasNoFormOfAReplyIsNone) {
    for (const TBytes& packet :
         {TBytes{0x90, 0xFF}, TBytes{0x80, 0x41, 0xFF}, TBytes{0x90, 0x41, 0x00, 0xFF},
          TBytes{0x90, 0x60, 0xFF}, TBytes{0x91, 0x41, 0xFF}, TBytes{0x90, 0x70, 0xFF},
          TBytes{0x88, 0x01, 0x00, 0x01, 0xFF}, TBytes{0x88, 0x30, 0xFF}}) {
        CViscaParser parser;
        EXPECT_TRUE(parse(parser, packet).empty()) << int(packet[0]) << " " << int(packet[1]);
        EXPECT_EQ(parser.counts().badPackets, 1U);
        EXPECT_EQ(parser.counts().strayBytes, packet.size());
    }
}

TEST(CViscaParser, APacketThatNeverEndsIsGivenUp) {
    CViscaParser parser;
    TBytes endless(1000, 0x01);
    endless[0] = 0x90;
    EXPECT_TRUE(parse(parser, endless).empty());
    EXPECT_EQ(parser.counts().strayBytes, 1000U);
    EXPECT_EQ(parse(parser, {0x90, 0x41, 0xFF}).size(), 1U);
    // Sixteen bytes with header and FF are the longest that there is.
    TBytes longest(16, 0x01);
    longest[0] = 0x90;
    longest[1] = 0x50;
    longest[15] = 0xFF;
    EXPECT_EQ(parse(parser, longest).size(), 1U);
    longest.insert(longest.begin() + 2, 0x01);
    EXPECT_TRUE(parse(parser, longest).empty());
}

TEST(CViscaParser, ResetForgetsAPacketThatHasBegun) {
    CViscaParser parser;
    parse(parser, {0x90, 0x41});
    parser.reset();
    EXPECT_TRUE(parse(parser, {0xFF}).empty());
}

namespace {

/// Replies with one to six bytes changed, taken out or put in, as `random` wills.
TBytes mutated(std::mt19937& random) {
    const auto below = [&random](std::size_t n) {
        return static_cast<std::ptrdiff_t>(random() % n);
    };
    TBytes bytes;
    for (int n = 0; n < 8; ++n) {
        const auto& packet = kReplies[static_cast<std::size_t>(below(kReplies.size()))];
        bytes.insert(bytes.end(), packet.begin(), packet.end());
    }
    for (auto n = 1 + below(6); n > 0; --n) {
        const auto at = bytes.begin() + below(bytes.size());
        const auto value = static_cast<std::uint8_t>(below(3) == 0 ? 0xFF : random());
        if (below(3) == 0)
            bytes.erase(at);
        else if (below(2) == 0)
            bytes.insert(at, value);
        else
            *at = value;
    }
    return bytes;
}

void expectSane(const TViscaReply& reply) {
    if (reply.kind == EViscaReply::addressSet)
        EXPECT_EQ(reply.data.size(), 1U);
    else
        EXPECT_TRUE(reply.address >= 1 && reply.address <= 7) << reply.address;
    EXPECT_TRUE(reply.socket >= 0 && reply.socket <= 15);
    EXPECT_LE(reply.data.size(), 13U);
    for (const auto byte : reply.data) EXPECT_LT(byte, 0x80);
}

}  // namespace

TEST(CViscaParser, CorruptedBytesNeverConfuseItForLong) {
    std::mt19937 random(20041);
    std::size_t bytes = 0, used = 0;
    CViscaParser parser;
    for (int run = 0; run < 50000; ++run) {
        const TBytes input = mutated(random);
        bytes += input.size();
        // In random pieces, as a port delivers them.
        for (std::size_t at = 0; at < input.size();) {
            const std::size_t piece = std::min<std::size_t>(1 + random() % 9, input.size() - at);
            for (const auto& reply : parser.push(input.data() + at, piece)) {
                expectSane(reply);
                // Header and second byte are not in `data`, nor is FF.
                used += reply.data.size() + 3;
                if (reply.kind == EViscaReply::error) ++used;
            }
            at += piece;
        }
        // Whatever came before, the next whole reply after an end is understood.
        const TBytes good{0xFF, 0x90, 0x42, 0xFF};
        const auto replies = parser.push(good.data(), good.size());
        bytes += good.size();
        ASSERT_FALSE(replies.empty());
        EXPECT_EQ(replies.back().kind, EViscaReply::acknowledge);
        EXPECT_EQ(replies.back().socket, 2);
        for (const auto& reply : replies) {
            expectSane(reply);
            used += reply.data.size() + 3;
            if (reply.kind == EViscaReply::error) ++used;
        }
    }
    // Every byte is accounted for: part of a reply, or stray.
    EXPECT_EQ(used + parser.counts().strayBytes, bytes);
}
