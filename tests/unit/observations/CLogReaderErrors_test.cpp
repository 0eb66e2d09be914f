// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <messages.h>
#include <salma/observations/CLogReader.h>

#include <cstring>
#include <random>

#include "CTemporaryFolder.h"
#include "examples.h"
#include "logs.h"

using namespace salma;
using mrpt::poses::CPose2D;
using observations::readLog;
using test::CTemporaryFolder;

namespace {

using salma::test::contains;

/// The message of a reader that must throw; "" (a failure) if it does not.
std::string messageOf(const std::string& file, bool acceptTruncated = false) {
    try {
        observations::TLogReaderOptions options;
        options.acceptTruncated = acceptTruncated;
        readLog(file, options);
    } catch (const std::runtime_error& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        EXPECT_EQ(message.find(file.substr(0, file.rfind('/'))), 0U) << message;
        return message;
    }
    ADD_FAILURE() << file << " was read";
    return "";
}

/// Two scans, a picture, odometry and both records of this project.
std::string observationLog() {
    return test::bytesOf({test::odometryAt(0, CPose2D()), test::scanAt(0.5),
                          test::pictureAt(0.75, "a.jpg"), test::exampleRecord(),
                          test::examplePanTilt(), test::odometryAt(2, CPose2D(1, 0, 0)),
                          test::scanAt(2.5)});
}

std::string actionLog() {
    return test::bytesOf(
        {test::motion(CPose2D(1, 0, 0)), test::frame({test::scanAt(0), test::exampleRecord()}),
         test::thrunMotion(CPose2D(1, 0, 0)), test::motion3D(mrpt::poses::CPose3D(), 0.1),
         test::frame({test::scanAt(1), test::odometryAt(1, CPose2D())})});
}

/// `bytes` with one to four bytes changed, or cut, as `random` wills.
std::string mutated(std::string bytes, std::mt19937& random) {
    const auto below = [&random](std::size_t n) { return random() % n; };
    if (below(4) == 0) return bytes.substr(0, below(bytes.size()));
    for (std::size_t n = 1 + below(4); n > 0; --n)
        bytes[below(bytes.size())] = static_cast<char>(below(3) == 0 ? 0xFF : random());
    return bytes;
}

/// Reads each mutant; whatever comes must be a log or one line of error.
void readMutants(const std::string& bytes, unsigned seed) {
    const CTemporaryFolder folder;
    std::mt19937 random(seed);
    int read = 0;
    int refused = 0;
    for (int i = 0; i < 200; ++i) {
        const std::string mutant = mutated(bytes, random);
        const auto file = folder.write("m.rawlog", i % 2 == 0 ? test::packed(mutant) : mutant);
        observations::TLogReaderOptions options;
        options.acceptTruncated = i % 4 < 2;
        try {
            readLog(file, options);
            ++read;
        } catch (const std::exception& error) {
            ++refused;
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
    }
    // Both must happen, or the mutations are too mild or too wild to test anything.
    EXPECT_GT(read, 10);
    EXPECT_GT(refused, 10);
}

}  // namespace

TEST(CLogReaderErrors, AMissingFileIsNamed) {
    EXPECT_TRUE(contains(messageOf("/nowhere/x.rawlog"), "/nowhere/x.rawlog: no such file"));
}

TEST(CLogReaderErrors, AFolderIsNoLog) {
    const CTemporaryFolder folder;
    EXPECT_TRUE(contains(messageOf(folder.path().string()), "is a folder"));
}

TEST(CLogReaderErrors, AnEmptyFileIsCalledEmptyAlsoWhenPacked) {
    const CTemporaryFolder folder;
    EXPECT_TRUE(contains(messageOf(folder.write("a.rawlog", "")), "is empty"));
    EXPECT_TRUE(contains(messageOf(folder.write("b.rawlog", test::packed(""))), "is empty"));
}

TEST(CLogReaderErrors, ForeignFilesAreNoRawlog) {
    const CTemporaryFolder folder;
    const std::string png("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\1\0", 20);
    const std::string jpeg("\xff\xd8\xff\xe0\0\x10JFIF\0\1", 12);
    const std::string text = "x y z\n1 2 3\n";
    for (const std::string& content : {png, jpeg, text, test::packed(text), test::packed(png)})
        EXPECT_TRUE(contains(messageOf(folder.write("f.rawlog", content)), "is not a rawlog"));
}

TEST(CLogReaderErrors, AnMrptFileThatIsNoRawlogSaysWhatItIs) {
    const CTemporaryFolder folder;
    std::string bytes = test::bytesOf({test::motion(CPose2D(1, 0, 0))});
    // A bare action where a collection of actions belongs.
    const std::size_t action = bytes.find("mrpt::obs::CActionRobotMovement2D") - 1;
    const std::string bare = bytes.substr(action, bytes.size() - 1 - action);
    const auto message = messageOf(folder.write("pose.rawlog", bare));
    EXPECT_TRUE(contains(message, "is not a rawlog: it holds mrpt::obs::CActionRobotMovement2D"))
        << message;
}

TEST(CLogReaderErrors, AnUnknownClassIsNamed) {
    const CTemporaryFolder folder;
    std::string bytes = test::bytesOf({test::scanAt(0), test::examplePanTilt()});
    bytes.replace(bytes.find("CObservationPanTilt"), 19, "CObservationUnheard");
    const auto message = messageOf(folder.write("u.rawlog", bytes));
    EXPECT_TRUE(contains(message, "'salma::observations::CObservationUnheard'")) << message;
    EXPECT_TRUE(contains(message, "after 1 whole records")) << message;
}

TEST(CLogReaderErrors, AnUnknownClassInAFrameIsNamed) {
    const CTemporaryFolder folder;
    std::string bytes =
        test::bytesOf({test::noMotion(), test::frame({test::scanAt(0), test::examplePanTilt()})});
    bytes.replace(bytes.find("CObservationPanTilt"), 19, "CObservationUnheard");
    EXPECT_TRUE(contains(messageOf(folder.write("u.rawlog", bytes)), "CObservationUnheard'"));
}

TEST(CLogReaderErrors, ATruncatedFileTellsItsLastGoodTime) {
    const CTemporaryFolder folder;
    const std::string bytes = test::bytesOf({test::scanAt(0.5), test::scanAt(1.5)});
    const std::string file = folder.write("t.rawlog", bytes.substr(0, bytes.size() - 5));
    const auto message = messageOf(file);
    EXPECT_TRUE(contains(message, "is truncated")) << message;
    EXPECT_TRUE(contains(message, "last good time 1000000000.500000 s")) << message;
    observations::TLogReaderOptions options;
    options.acceptTruncated = true;
    const auto log = readLog(file, options);
    EXPECT_TRUE(log.truncated);
    EXPECT_EQ(log.steps.size(), 1U);
    EXPECT_EQ(log.lastGoodTime, test::kStart + 0.5);
}

TEST(CLogReaderErrors, ATruncatedGzipFileIsToldAlsoWhereARecordEnds) {
    const CTemporaryFolder folder;
    test::TObjects scans;
    for (int i = 0; i < 50; ++i) scans.push_back(test::scanAt(i));
    const std::string gzip = test::packed(test::bytesOf(scans));
    // Only the check sum is missing: every record is whole.
    const std::string file = folder.write("t.rawlog", gzip.substr(0, gzip.size() - 8));
    EXPECT_TRUE(contains(messageOf(file), "after 50 whole records")) << messageOf(file);
    observations::TLogReaderOptions options;
    options.acceptTruncated = true;
    EXPECT_EQ(readLog(file, options).steps.size(), 50U);
    // Nothing whole is no log, even where a truncated one is welcome.
    EXPECT_TRUE(contains(messageOf(folder.write("u.rawlog", gzip.substr(0, 12)), true),
                         "in its first record"));
}

TEST(CLogReaderErrors, ADamagedGzipFileIsToldBeforeItIsUsed) {
    const CTemporaryFolder folder;
    std::string gzip = test::packed(observationLog());
    gzip[gzip.size() - 6] ^= 1;  // the check sum
    const auto message = messageOf(folder.write("d.rawlog", gzip), true);
    EXPECT_TRUE(contains(message, "is damaged")) << message;
}

TEST(CLogReaderErrors, AFaultOfTheCompanionNamesTheCompanion) {
    const CTemporaryFolder folder;
    const auto file = folder.write("x.rawlog", test::bytesOf({test::scanAt(0)}));
    folder.write("x.salient.rawlog", "nonsense");
    EXPECT_TRUE(contains(messageOf(file), "x.salient.rawlog: is not a rawlog"));
}

TEST(CLogReaderErrors, CountsBeyondTheFileAreRefusedBeforeMrptBelievesThem) {
    const CTemporaryFolder folder;
    const auto refusedWith = [&folder](std::string bytes, std::uint32_t find) {
        std::string pattern(4, '\0');
        std::memcpy(pattern.data(), &find, 4);
        const std::size_t at = bytes.find(pattern);
        if (at == std::string::npos) return std::string("the example has changed");
        const std::uint32_t huge = 0x7FFFFFFF;
        std::memcpy(&bytes[at], &huge, 4);
        return messageOf(folder.write("h.rawlog", bytes));
    };
    const std::string claim = "claims 2147483647 elements";
    const auto scan = test::bytesOf({test::scanAt(0)});
    EXPECT_TRUE(contains(refusedWith(scan, 11), claim)) << refusedWith(scan, 11);
    const auto thrun = test::bytesOf({test::thrunMotion(CPose2D(1, 0, 0))});
    EXPECT_TRUE(contains(refusedWith(thrun, 50), claim)) << refusedWith(thrun, 50);
    for (const bool own : {false, true}) {
        const auto bearings = test::bytesOf({test::bearings(13, own)});
        EXPECT_TRUE(contains(refusedWith(bearings, 13), claim)) << refusedWith(bearings, 13);
    }
    const auto frames = test::bytesOf({test::frame(
        std::vector<mrpt::obs::CObservation::Ptr>(17, test::odometryAt(0, CPose2D())))});
    EXPECT_TRUE(contains(refusedWith(frames, 17), claim)) << refusedWith(frames, 17);
}

TEST(CLogReaderErrors, FalseSizesOfMatricesAndVelocitiesAreRefused) {
    const CTemporaryFolder folder;
    const auto refusedAt = [&folder](std::string bytes, std::size_t at, const std::string& was) {
        EXPECT_EQ(bytes.substr(at, was.size()), was);
        bytes.replace(at, 4, "\xff\xff\xff\x7f");
        return messageOf(folder.write("h.rawlog", bytes));
    };
    const std::string three("\3\0\0\0\3\0\0\0", 8);
    const auto matrix = test::bytesOf({test::bearings(1, true)});
    const std::size_t sides = matrix.find("CMatrixD") + 9;
    EXPECT_TRUE(contains(refusedAt(matrix, sides, three), "claims 6442450941 elements"));
    const auto motion = test::bytesOf({test::motion3D(mrpt::poses::CPose3D(), 0.1)});
    const std::string six("\6\0\0\0\0\0\0\0\0\0\6\0\0\0", 14);
    const std::size_t flags = motion.find(six);
    EXPECT_TRUE(contains(refusedAt(motion, flags, six), "claims 2147483647 elements"));
    EXPECT_TRUE(contains(refusedAt(motion, flags + 10, "\6"), "claims 2147483647 elements"));
}

TEST(CLogReaderErrors, AMovementWhoseDensityIsNoneIsRefused) {
    const CTemporaryFolder folder;
    std::string bytes = test::bytesOf({test::motion(CPose2D(1, 0, 0))});
    // The method of estimation becomes scan matching, but the pose of odometry still follows.
    bytes[bytes.find("CActionRobotMovement2D") + 23] = 1;
    const auto message = messageOf(folder.write("m.rawlog", bytes));
    EXPECT_TRUE(contains(message, "holds a movement without a density")) << message;
}

TEST(CLogReaderErrors, MutantsOfAnObservationLogAreReadOrRefused) {
    readMutants(observationLog(), 1);
}

TEST(CLogReaderErrors, MutantsOfAnActionLogAreReadOrRefused) { readMutants(actionLog(), 2); }
