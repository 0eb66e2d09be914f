// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/drivers/CSentenceParser.h>

#include <cmath>
#include <random>

using namespace salma::drivers;

namespace {

std::vector<TSentence> parse(CSentenceParser& parser, const std::string& text) {
    return parser.push(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

std::string sentence(const std::string& text) {
    unsigned sum = 0;
    for (const char c : text) sum ^= static_cast<unsigned char>(c);
    char end[8];
    std::snprintf(end, sizeof end, "*%02X\r\n", sum);
    return "$" + text + end;
}

}  // namespace

/// The checksum of NMEA 0183's best known sentence.
TEST(CSentenceParser, CountsTheChecksumAsNmeaDoes) {
    EXPECT_EQ(sentence("GPGLL,5300.97914,N,00259.98174,E,125926,A"),
              "$GPGLL,5300.97914,N,00259.98174,E,125926,A*28\r\n");
}

TEST(CSentenceParser, ReadsNamesAndNumbers) {
    CSentenceParser parser;
    const auto sentences = parse(parser, sentence("ODO,1.5,-2,0.25e1") + sentence("UP"));
    ASSERT_EQ(sentences.size(), 2U);
    EXPECT_EQ(sentences[0].name, "ODO");
    EXPECT_EQ(sentences[0].values, (std::vector<double>{1.5, -2, 2.5}));
    EXPECT_EQ(sentences[1].name, "UP");
    EXPECT_TRUE(sentences[1].values.empty());
    EXPECT_EQ(parser.counts().badSentences, 0U);
}

TEST(CSentenceParser, ASentenceKeepsTheTimeOfItsFirstByte) {
    CSentenceParser parser;
    const std::string text = "x" + sentence("A,1") + sentence("A,2");  // 1 + 9 + 9 bytes
    const auto sentences =
        parser.push(reinterpret_cast<const std::uint8_t*>(text.data()), text.size(), 10, 0.1);
    ASSERT_EQ(sentences.size(), 2U);
    EXPECT_NEAR(sentences[0].began, 10 - 1.7, 1e-12);
    EXPECT_NEAR(sentences[1].began, 10 - 0.8, 1e-12);
}

TEST(CSentenceParser, WhatIsNoSentenceIsSkipped) {
    for (const std::string& bad :
         {std::string("$ODO,1*00\r\n"), std::string("$ODO,1\r\n"), sentence("ODO,one"),
          sentence("ODO,nan"), sentence("ODO,inf"), sentence("ODO,1e999"), sentence("ODO,"),
          sentence("ODO,1 "), sentence(",1"), sentence(""), std::string("$*\r\n"),
          std::string("$ODO,1*2\r\n"), sentence("A*B"), std::string("$ODO,1"),
          sentence("ODO," + std::string(80, '1'))}) {
        CSentenceParser parser;
        const auto sentences = parse(parser, bad + sentence("ODO,7"));
        ASSERT_EQ(sentences.size(), 1U) << bad;
        EXPECT_EQ(sentences[0].values, std::vector<double>{7});
        EXPECT_EQ(parser.counts().badSentences, 1U) << bad;
    }
}

TEST(CSentenceParser, CorruptedBytesNeverConfuseItForLong) {
    std::mt19937 random(20043);
    CSentenceParser parser;
    for (int run = 0; run < 20000; ++run) {
        std::string text = sentence("ODO,1.25,-3,90") + sentence("NOD,-20");
        for (auto n = 1 + random() % 5; n > 0 && !text.empty(); --n) {
            const auto at = random() % text.size();
            const char special[] = {'$', '*', ',', '\n', 'e', '-'};
            const char value =
                random() % 2 == 0 ? special[random() % 6] : static_cast<char>(random());
            if (random() % 3 == 0)
                text.erase(at, 1);
            else
                text[at] = value;
        }
        for (const auto& found : parse(parser, text)) {
            EXPECT_FALSE(found.name.empty());
            EXPECT_LE(found.values.size(), CSentenceParser::maxSentence / 2);
            for (const double value : found.values) EXPECT_TRUE(std::isfinite(value));
        }
        const auto good = parse(parser, "\n" + sentence("ODO,7"));
        ASSERT_FALSE(good.empty());
        EXPECT_EQ(good.back().values, std::vector<double>{7});
    }
}
