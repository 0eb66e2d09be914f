// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/observations/TPlaceString.h>

#include <limits>
#include <random>
#include <stdexcept>

namespace salma::observations {
namespace {

void expectEqual(const TPlaceString& a, const TPlaceString& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].letter, b[i].letter) << i;
        EXPECT_EQ(a[i].value, b[i].value) << i;
        EXPECT_EQ(a[i].sigma, b[i].sigma) << i;
    }
}

TEST(TPlaceString, IsReadAsItWasWritten) {
    const TPlaceString place{{'W', 4.2, 0.05}, {'c', 0, 0}, {'J', -1, 0},  {'O', 0.9, 0.1},
                             {'X', 0, 0},      {'C', 0, 0}, {'W', 0, 0.5}, {'W', 1.0 / 3, 1e-9}};
    EXPECT_EQ(asText(place).substr(0, 28), "W4.2~0.05 c J-1 O0.9~0.1 X C");
    expectEqual(parsePlaceString(asText(place)), place);
    EXPECT_EQ(asText({}), "");
    EXPECT_TRUE(parsePlaceString(" \t\n").empty());
    expectEqual(parsePlaceString("  W4.2~0.05\tc\n"), {{'W', 4.2, 0.05}, {'c', 0, 0}});
}

TEST(TPlaceString, RefusesTextThatIsNone) {
    for (const char* text : {"w1", "W1 Q", "W1~", "W~1", "W1~-0.1", "W1~0.1x", "Wnan", "W1~inf",
                             "W1e999", "W--1", "W1,2", "WW", "c c c ?", "W0x10", "W1~0.1~0.1"})
        EXPECT_THROW(parsePlaceString(text), std::invalid_argument) << text;
    try {
        parsePlaceString("W1 c W2~z");
        FAIL();
    } catch (const std::invalid_argument& e) {
        EXPECT_STREQ(e.what(), "place string: letter 3 'W2~z' has no finite number");
    }
    EXPECT_THROW(asText({{'?', 0, 0}}), std::invalid_argument);
    EXPECT_THROW(asText({{'W', 1, -1}}), std::invalid_argument);
    EXPECT_THROW(asText({{'W', std::numeric_limits<double>::infinity(), 0}}),
                 std::invalid_argument);
}

TEST(TPlaceString, DamagedTextIsRefusedOrReadAsWhatItSays) {
    const std::string good = "W4.203~0.05 c W1.3~0.612 J1 O0.92~0.1 W2.4 J-1 C X W0.5~1";
    const std::string others = "WCcJOX~.-+eE0123456789 \t\0nai,;#\xff";
    std::mt19937 random(3);
    std::size_t refused = 0, read = 0;
    for (int round = 0; round < 20000; ++round) {
        std::string text = good;
        for (std::size_t edits = 1 + random() % 4; edits > 0 && !text.empty(); --edits) {
            const std::size_t at = random() % text.size();
            switch (random() % 4) {
                case 0:
                    text[at] = others[random() % others.size()];
                    break;
                case 1:
                    text.insert(at, 1, others[random() % others.size()]);
                    break;
                case 2:
                    text.erase(at, 1 + random() % 5);
                    break;
                default:
                    text.resize(at);
            }
        }
        try {
            const TPlaceString place = parsePlaceString(text);
            expectEqual(parsePlaceString(asText(place)), place);
            ++read;
        } catch (const std::invalid_argument& e) {
            EXPECT_EQ(std::string(e.what()).substr(0, 21), "place string: letter ");
            ++refused;
        }
    }
    EXPECT_GT(refused, 1000u);
    EXPECT_GT(read, 1000u);
}

}  // namespace
}  // namespace salma::observations
