// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <salma/config/CStrictSection.h>

#include <cmath>

namespace salma::config {
namespace {

mrpt::config::CConfigFileMemory ini(const std::string& text) {
    return mrpt::config::CConfigFileMemory("[s]\n" + text);
}

std::string errorOf(const std::string& text, const TRange& range) {
    const auto file = ini(text);
    double x = 0;
    try {
        CStrictSection(file, "s").number("x", x, range);
    } catch (const std::invalid_argument& e) {
        return e.what();
    }
    return "";
}

TEST(CStrictSection, NamesFileSectionKeyAndTextOfAMalformedNumber) {
    EXPECT_EQ(errorOf("x = 1.5m\n", anyNumber()), "(memory): [s] x = '1.5m' is not a number");
}

TEST(CStrictSection, RefusesNumbersOutsideTheRangeAndThoseThatAreNotFinite) {
    EXPECT_EQ(errorOf("x = 1\n", insideOf(0, 1)), "(memory): [s] x = '1' is outside (0, 1)");
    EXPECT_EQ(errorOf("x = 1\n", between(0, 1)), "");
    EXPECT_NE(errorOf("x = nan\n", anyNumber()), "");
    EXPECT_NE(errorOf("x = inf\n", anyNumber()), "");
}

TEST(CStrictSection, RejectsAMisspeltKey) {
    const auto file = ini("xx = 1\n");
    CStrictSection section(file, "s");
    double x = 7;
    section.number("x", x, anyNumber());
    EXPECT_EQ(x, 7);
    EXPECT_THROW(section.rejectUnknownKeys(), std::invalid_argument);
    EXPECT_EQ(file.read_double("s", "x", 7), 7) << "MRPT alone keeps the default silently";
}

TEST(CStrictSection, ReadsDegreesBehindAComment) {
    const auto file = ini("x_deg = 180  // half a turn\n");
    double x = 0;
    CStrictSection(file, "s").degrees("x_deg", x, anyNumber(), "");
    EXPECT_NEAR(x, M_PI, 1e-12);
}

TEST(CStrictSection, TakesACommentBehindNoValueForNoValue) {
    const auto file = ini("name =   // nothing here\n");
    std::string name = "before";
    CStrictSection(file, "s").text("name", name);
    EXPECT_EQ(name, "");
}

TEST(CStrictSection, ReadsWholeNumbersFlagsWordsAndLists) {
    const auto file = ini("n = 3\nhalf = 0.5\nyes = true\nodd = 1\nmode = b\nall = 1 2.5 -3\n");
    CStrictSection section(file, "s");
    int n = 0;
    section.integer("n", n, atLeast(0));
    EXPECT_EQ(n, 3);
    EXPECT_THROW(section.integer("half", n, anyNumber()), std::invalid_argument);
    bool yes = false;
    section.flag("yes", yes);
    EXPECT_TRUE(yes);
    EXPECT_THROW(section.flag("odd", yes), std::invalid_argument);
    char mode = 'a';
    section.choice<char>("mode", mode, {{"a", 'a'}, {"b", 'b'}}, "");
    EXPECT_EQ(mode, 'b');
    EXPECT_THROW((section.choice<char>("mode", mode, {{"a", 'a'}, {"c", 'c'}}, "")),
                 std::invalid_argument);
    std::vector<double> all;
    section.numbers("all", all, anyNumber());
    EXPECT_EQ(all, (std::vector<double>{1, 2.5, -3}));
}

}  // namespace
}  // namespace salma::config
