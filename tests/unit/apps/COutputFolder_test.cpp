// SPDX-License-Identifier: BSD-3-Clause
#include "COutputFolder.h"

#include <CTemporaryFolder.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <stdexcept>

namespace salma::apps {
namespace {

namespace fs = std::filesystem;
using test::CTemporaryFolder;
using test::readFile;

void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

/// Names in a folder, without the hidden mark that tells our folders.
std::set<std::string> namesIn(const fs::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (name != ".salma-output") names.insert(name);
    }
    return names;
}

using TNames = std::set<std::string>;

/// A finished run that left one file.
void publishOne(const fs::path& target, const std::string& name, const std::string& text) {
    COutputFolder out(target);
    write(out / name, text);
    out.publish();
}

/// The message with which `target` is refused; "" if it is taken.
std::string refusalOf(const fs::path& target) {
    try {
        const COutputFolder out(target);
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "";
}

TEST(COutputFolder, ShowsNothingBeforePublishAndAllAfterIt) {
    const CTemporaryFolder folder;
    {
        COutputFolder out(folder / "new/run");  // its parent is not there either
        write(out / "a.txt", "1");
        fs::create_directory(out / "pictures");
        write(out / "pictures" / "b.txt", "2");
        EXPECT_FALSE(fs::exists(folder / "new/run"));
        out.publish();
        EXPECT_EQ(namesIn(folder / "new/run"), (TNames{"a.txt", "pictures"}));
    }
    EXPECT_EQ(readFile(folder / "new/run/a.txt"), "1");
    EXPECT_EQ(readFile(folder / "new/run/pictures/b.txt"), "2");
    EXPECT_EQ(namesIn(folder / "new"), TNames{"run"});
}

TEST(COutputFolder, LeavesNothingWithoutPublish) {
    const CTemporaryFolder folder;
    {
        const COutputFolder out(folder / "run");
        write(out / "a.txt", "1");
    }
    EXPECT_EQ(namesIn(folder.path()), TNames{});
}

TEST(COutputFolder, KeepsTheResultsThatAreThereWithoutPublish) {
    const CTemporaryFolder folder;
    publishOne(folder / "run", "a.txt", "old");
    {
        const COutputFolder out(folder / "run");
        write(out / "a.txt", "new");
    }
    EXPECT_EQ(readFile(folder / "run/a.txt"), "old");
    EXPECT_EQ(namesIn(folder.path()), TNames{"run"});
}

TEST(COutputFolder, ReplacesTheResultsOfAnEarlierRun) {
    const CTemporaryFolder folder;
    publishOne(folder / "run", "a.txt", "old");
    publishOne(folder / "run", "b.txt", "new");
    EXPECT_EQ(namesIn(folder / "run"), TNames{"b.txt"});
    EXPECT_EQ(namesIn(folder.path()), TNames{"run"});
}

TEST(COutputFolder, TakesAnEmptyFolder) {
    const CTemporaryFolder folder;
    fs::create_directory(folder / "run");
    publishOne(folder / "run", "a.txt", "1");
    EXPECT_EQ(readFile(folder / "run/a.txt"), "1");
}

TEST(COutputFolder, RefusesAFolderOfSomebodyElseAndNamesIt) {
    const CTemporaryFolder folder;
    folder.write("thesis.tex", "years of work");
    const std::string message = refusalOf(folder.path());
    EXPECT_EQ(message.find(folder.path().string() + ": "), 0U) << message;
    EXPECT_NE(message.find("was not written by salma"), std::string::npos) << message;
    EXPECT_EQ(readFile(folder / "thesis.tex"), "years of work");
    EXPECT_EQ(namesIn(folder.path()), TNames{"thesis.tex"});
}

TEST(COutputFolder, RefusesAFileInTheWay) {
    const CTemporaryFolder folder;
    folder.write("run", "a file");
    const std::string message = refusalOf(folder / "run");
    EXPECT_NE(message.find("run: exists and is not a folder"), std::string::npos) << message;
    EXPECT_NE(refusalOf(folder / "run/below"), "");
    EXPECT_EQ(readFile(folder / "run"), "a file");
    EXPECT_EQ(namesIn(folder.path()), TNames{"run"});
}

TEST(COutputFolder, AddsToTheFolderAndKeepsItsOtherFiles) {
    const CTemporaryFolder folder;
    {
        COutputFolder out(folder / "run");
        write(out / "kept.txt", "1");
        write(out / "changed.txt", "1");
        fs::create_directory(out / "pictures");
        write(out / "pictures" / "old.jpg", "1");
        out.publishInto();  // nothing there yet
    }
    {
        COutputFolder out(folder / "run");
        write(out / "changed.txt", "2");
        write(out / "added.txt", "2");
        fs::create_directory(out / "pictures");
        write(out / "pictures" / "new.jpg", "2");
        out.publishInto();
    }
    EXPECT_EQ(namesIn(folder / "run"),
              (TNames{"added.txt", "changed.txt", "kept.txt", "pictures"}));
    EXPECT_EQ(readFile(folder / "run/kept.txt"), "1");
    EXPECT_EQ(readFile(folder / "run/changed.txt"), "2");
    EXPECT_EQ(namesIn(folder / "run/pictures"), TNames{"new.jpg"});
    EXPECT_EQ(namesIn(folder.path()), TNames{"run"});
    EXPECT_EQ(refusalOf(folder / "run"), "");
}

TEST(COutputFolder, TakesATrailingSlash) {
    const CTemporaryFolder folder;
    publishOne(folder.path().string() + "/run/", "a.txt", "1");
    publishOne(folder.path().string() + "/run/", "b.txt", "2");
    EXPECT_EQ(namesIn(folder.path()), TNames{"run"});
    EXPECT_EQ(namesIn(folder / "run"), TNames{"b.txt"});
}

}  // namespace
}  // namespace salma::apps
