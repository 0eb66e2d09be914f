// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <messages.h>
#include <salma/saliency/CExternalDetector.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <stdexcept>

#include "CEnvironmentVariable.h"
#include "CTemporaryFolder.h"

namespace salma::saliency {
namespace {

using salma::test::contains;

namespace fs = std::filesystem;

constexpr auto kGood = "1.0\n2\n10 20 0.01 0 0.01\n30.5 40 0.04 -0.001 0.02\n";

cv::Mat grey() {
    cv::Mat picture(60, 80, CV_8UC1);
    cv::RNG(1).fill(picture, cv::RNG::UNIFORM, 0, 256);
    return picture;
}

/// A shell script as the program; $1 is the picture, $2 the region file.
class ExternalDetector : public testing::Test {
 protected:
    std::vector<TEllipse> run(const std::string& script, double timeLimit = 20) {
        const std::string program = m_folder.write("detector", "#!/bin/sh\n" + script + "\n");
        fs::permissions(program, fs::perms::owner_all);
        TExternalOptions options;
        options.command = program + " {image} {regions}";
        options.timeLimit = timeLimit;
        options.maxRegions = 1000;
        return CExternalDetector(options).detect(grey());
    }

    std::string complaint(const std::string& script, double timeLimit = 20) {
        try {
            run(script, timeLimit);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "";
    }

    std::string path(const std::string& name) const { return (m_folder / name).string(); }

    test::CTemporaryFolder m_folder;
};

}  // namespace

TEST_F(ExternalDetector, GivesTheRegionsThatTheProgramWrites) {
    m_folder.write("good", kGood);
    const auto regions = run("cp " + path("good") + " $2");
    ASSERT_EQ(regions.size(), 2u);
    EXPECT_EQ(regions[1].u, 30.5);
    EXPECT_EQ(regions[1].b, -0.001);
}

TEST_F(ExternalDetector, GivesTheProgramThePicture) {
    m_folder.write("good", kGood);
    run("cp $1 " + path("seen.pgm") + "; cp " + path("good") + " $2");
    const cv::Mat seen = cv::imread(path("seen.pgm"), cv::IMREAD_UNCHANGED);
    ASSERT_EQ(seen.type(), CV_8UC1);
    EXPECT_EQ(cv::norm(seen, grey(), cv::NORM_INF), 0);
}

TEST_F(ExternalDetector, LeavesOutRegionsBesideThePicture) {
    m_folder.write("some", "0\n4\n-1 5 1 0 1\n79 59 1 0 1\n79.1 5 1 0 1\n5 60 1 0 1\n");
    const auto regions = run("cp " + path("some") + " $2");
    ASSERT_EQ(regions.size(), 1u);
    EXPECT_EQ(regions[0].u, 79);
}

TEST_F(ExternalDetector, SurvivesAProgramThatCrashes) {
    const auto text = complaint("echo 'out of luck' >&2; kill -SEGV $$");
    EXPECT_TRUE(contains(text, "was ended by a signal, Segmentation fault: out of luck")) << text;
    EXPECT_TRUE(
        contains(complaint("echo; echo no licence; exit 3"), "ended with exit code 3: no licence"));
}

TEST_F(ExternalDetector, EndsAProgramThatHangsAndAllThatItStarted) {
    // The sleeping grandchild would keep the pipe open for its 100 s.
    const auto start = std::chrono::steady_clock::now();
    const auto text = complaint("sleep 100 & echo $! > " + path("pid") + "; echo busy; wait", 0.5);
    EXPECT_TRUE(contains(text, "did not end within 0.5 s: busy")) << text;
    const auto seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    EXPECT_LT(seconds, 60) << "it was not waited for";
    std::ifstream in(path("pid"));
    int grandchild = 0;
    in >> grandchild;
    ASSERT_GT(grandchild, 0);
    std::ifstream status("/proc/" + std::to_string(grandchild) + "/stat");
    std::string line;
    std::getline(status, line);
    EXPECT_TRUE(line.empty() || contains(line, ") Z")) << line;
}

TEST_F(ExternalDetector, DoesNotWaitForWhatAProgramLeavesBehind) {
    m_folder.write("good", kGood);
    EXPECT_EQ(run("cp " + path("good") + " $2; sleep 100 &", 50).size(), 2u);
}

TEST_F(ExternalDetector, SurvivesEndlessOutput) {
    const auto file = complaint("yes '1 2 3 0 3' > $2", 120);
    EXPECT_TRUE(contains(file, "File size limit exceeded") || contains(file, "exit code 1"))
        << file;
    const auto spoken = complaint("yes", 0.5);
    EXPECT_TRUE(contains(spoken, "did not end within 0.5 s: y")) << spoken;
    EXPECT_TRUE(contains(complaint("echo 1.0 > $2; echo 1001 >> $2"), "from 0 to 1000"));
}

TEST_F(ExternalDetector, NamesTheLineOfAFileThatIsNone) {
    EXPECT_TRUE(contains(complaint("exit 0"), "wrote no region file"));
    EXPECT_TRUE(contains(complaint("mkdir $2"), "wrote no region file"));
    EXPECT_TRUE(contains(complaint(": > $2"), "line:0: file ends before"));
    EXPECT_TRUE(contains(complaint("cp $1 $2"), "wrote no good region file, line:1:"));
    EXPECT_TRUE(contains(complaint("printf '1.0\\n2\\n1 2 3 0 3\\n' > $2"),
                         "line:3: file ends after 1 of 2 regions"));
    EXPECT_TRUE(contains(complaint("printf '<regions/>\\n' > $2"), "is not a finite number"));
}

TEST_F(ExternalDetector, SaysWhichProgramCannotBeStarted) {
    TExternalOptions options;
    options.command = path("missing") + " {image} {regions}";
    try {
        CExternalDetector(options).detect(grey());
        ADD_FAILURE();
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(std::string(error.what()), "external detector '" + path("missing") +
                                                 "' cannot be started: No such file or directory");
    }
    options.command = "";
    EXPECT_THROW(CExternalDetector(options).detect(grey()), std::runtime_error);
}

TEST_F(ExternalDetector, LeavesNoFilesBehind) {
    // A folder of this test's own: tests beside it have scratch folders too.
    const test::CTemporaryFolder scratch;
    const test::CEnvironmentVariable folder("TMPDIR", scratch.path().string());
    m_folder.write("good", kGood);
    run("cp " + path("good") + " $2");
    complaint("test -s $1 || exit 2; exit 1");
    complaint("sleep 100", 0.1);
    EXPECT_TRUE(fs::is_empty(scratch.path()));
    run("dirname $1 > " + path("used") + "; cp " + path("good") + " $2");
    std::ifstream used(path("used"));
    std::string where;
    std::getline(used, where);
    EXPECT_EQ(fs::path(where).parent_path(), scratch.path());
}

TEST_F(ExternalDetector, EitherTakesOrRefusesAnyBrokenFile) {
    std::mt19937 random(21);
    int refused = 0;
    for (int i = 0; i < 40; ++i) {
        std::string text = kGood;
        text.resize(i % 3 == 0 ? random() % text.size() : text.size());
        for (std::size_t k = 0; k < 1 + random() % 4 && !text.empty(); ++k)
            text[random() % text.size()] = static_cast<char>(random() % 256);
        m_folder.write("broken", text);
        const auto said = complaint("cp " + path("broken") + " $2");
        if (said.empty()) continue;
        ++refused;
        EXPECT_TRUE(contains(said, "wrote no good region file, line:")) << said;
    }
    EXPECT_GT(refused, 10);
}

TEST(ExternalOptions, AreCheckedBeforeAnythingIsRun) {
    TExternalOptions options;
    const auto complaint = [&](const std::string& command) {
        options.command = command;
        try {
            options.validate();
        } catch (const std::invalid_argument& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(complaint("mser.ln -i {image} -o {regions}"), "");
    EXPECT_EQ(complaint("\"/opt/my tools/mser\" {image} {regions}"), "");
    EXPECT_TRUE(contains(complaint("mser.ln -o {regions}"), "lacks {image}"));
    EXPECT_TRUE(contains(complaint("mser.ln -i {image}"), "lacks {regions}"));
    EXPECT_TRUE(contains(complaint("\"mser.ln {image} {regions}"), "closing quote"));
    options.timeLimit = 0;
    EXPECT_TRUE(contains(complaint("a {image} {regions}"), "time_limit_s"));
}

TEST_F(ExternalDetector, TakesQuotedWordsForOne) {
    m_folder.write("good", kGood);
    const std::string program =
        m_folder.write("my tools/detector", "#!/bin/sh\ncp \"$1\" \"$3\"\n");
    fs::permissions(program, fs::perms::owner_all);
    TExternalOptions options;
    options.command = "\"" + program + "\"  " + path("good") + " {image} {regions}";
    EXPECT_EQ(CExternalDetector(options).detect(grey()).size(), 2u);
}

}  // namespace salma::saliency
