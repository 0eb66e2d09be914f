// SPDX-License-Identifier: BSD-3-Clause
#include <CTemporaryFolder.h>
#include <gtest/gtest.h>
#include <salma/viz/CCsvTable.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace salma::viz {
namespace {

const std::vector<std::string> kColumns{"id", "x_m", "name"};

/// Reads every cell of a table of kColumns.
std::string errorOf(const std::string& text) {
    const test::CTemporaryFolder folder;
    const std::string file = folder.write("a.csv", text);
    try {
        const CCsvTable table(file, kColumns);
        for (std::size_t i = 0; i < table.rows(); ++i) {
            table.integer(i, "id");
            table.numberOrNaN(i, "x_m");
        }
    } catch (const std::invalid_argument& e) {
        const std::string what = e.what();
        return what.substr(what.find("a.csv"));
    }
    return "";
}

TEST(CCsvTable, ReadsNumbersTextsAndEmptyCells) {
    const test::CTemporaryFolder folder;
    const CCsvTable table(folder.write("a.csv", "id,x_m,name\n3,-1.5e2,a b\r\n-4,,\n"), kColumns);
    ASSERT_EQ(table.rows(), 2U);
    EXPECT_EQ(table.integer(0, "id"), 3);
    EXPECT_EQ(table.number(0, "x_m"), -150);
    EXPECT_EQ(table.text(0, "name"), "a b");
    EXPECT_EQ(table.integer(1, "id"), -4);
    EXPECT_TRUE(std::isnan(table.numberOrNaN(1, "x_m")));
    EXPECT_THROW(table.number(1, "x_m"), std::invalid_argument);
    EXPECT_EQ(table.integerOr(1, "name", 7), 7);
}

TEST(CCsvTable, NamesFileLineColumnAndValue) {
    EXPECT_EQ(errorOf(""), "a.csv:1: the header must be id,x_m,name");
    EXPECT_EQ(errorOf("id,name,x_m\n"), "a.csv:1: the header must be id,x_m,name");
    EXPECT_EQ(errorOf("id,x_m,name\n1,2,a\n1,2\n"), "a.csv:3: 2 cells instead of 3");
    EXPECT_EQ(errorOf("id,x_m,name\n1,2,a,b\n"), "a.csv:2: 4 cells instead of 3");
    EXPECT_EQ(errorOf("id,x_m,name\n1.5,2,a\n"), "a.csv:2: id = '1.5' is not an integer");
    EXPECT_EQ(errorOf("id,x_m,name\n1,inf,a\n"), "a.csv:2: x_m = 'inf' is not a finite number");
    EXPECT_EQ(errorOf("id,x_m,name\n1,2m,a\n"), "a.csv:2: x_m = '2m' is not a finite number");
    EXPECT_EQ(errorOf("id,x_m,name\n99999999999,2,a\n"),
              "a.csv:2: id = '99999999999' is not an integer");
    EXPECT_THROW(CCsvTable("no-such.csv", kColumns), std::runtime_error);
}

TEST(CCsvTable, TakesOrRefusesAnyDamagedFileWithoutCrashing) {
    const std::string good = "id,x_m,name\n1,2.5,abc\n2,,d\n3,-1e-3,\n";
    std::mt19937 random(11);
    std::size_t refused = 0;
    for (int i = 0; i < 400; ++i) {
        std::string text = good;
        text[random() % text.size()] = static_cast<char>(random() % 256);
        if (i % 3 == 0) text.resize(random() % text.size());
        refused += errorOf(text).empty() ? 0 : 1;
    }
    EXPECT_GT(refused, 100U);
}

}  // namespace
}  // namespace salma::viz
