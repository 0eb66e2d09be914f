// SPDX-License-Identifier: BSD-3-Clause
#include <CTemporaryFolder.h>
#include <gtest/gtest.h>
#include <salma/config/CStrictFile.h>

#include <stdexcept>

namespace salma::config {
namespace {

std::string errorOf(const std::string& text) {
    const test::CTemporaryFolder folder;
    const std::string file = folder.write("a.ini", text);
    try {
        rejectUnknownSections(*openStrict(file), {"known", "many_*"});
    } catch (const std::invalid_argument& e) {
        const std::string what = e.what();
        return what.substr(what.find("a.ini"));
    }
    return "";
}

TEST(CStrictFile, AcceptsCommentsAndKnownSections) {
    EXPECT_EQ(errorOf("# a\n; b\n// c\n\n[known]\nx = 1 // d\n[many_1]\ny=2\n"), "");
}

TEST(CStrictFile, NamesTheLineOfWhatMrptWouldSkip) {
    EXPECT_EQ(errorOf("[known]\nx 1\n"), "a.ini:2: 'x 1' is not 'key = value'");
    EXPECT_EQ(errorOf("x = 1\n"), "a.ini:1: key 'x' stands before any section");
    EXPECT_EQ(errorOf("[known\nx = 1\n"), "a.ini:1: section '[known' lacks its ']'");
}

TEST(CStrictFile, RefusesWhatWouldOverwriteAnEarlierLine) {
    EXPECT_EQ(errorOf("[known]\nx = 1\nx = 2\n"), "a.ini:3: [known] x stands twice");
    EXPECT_EQ(errorOf("[known]\n[known]\n"), "a.ini:2: section [known] stands twice");
}

TEST(CStrictFile, RefusesUnknownSectionsMissingFilesAndFolders) {
    EXPECT_EQ(errorOf("[knwon]\nx = 1\n"), "a.ini: unknown sections: [knwon]");
    EXPECT_THROW(openStrict("no-such.ini"), std::invalid_argument);
    EXPECT_THROW(openStrict("/"), std::invalid_argument);
}

}  // namespace
}  // namespace salma::config
