// SPDX-License-Identifier: BSD-3-Clause
#include <CProcess.h>
#include <CTemporaryFolder.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CRawlog.h>

#include <filesystem>

namespace salma {
namespace {

namespace fs = std::filesystem;

/// Copies the first 3000 entries of the shipped log, with all focal lengths times `factor`.
void copyWithFocalLength(double factor, const fs::path& copy) {
    const fs::path shipped = SALMA_SOURCE_DIR "/rawlogs/hallway-loop.rawlog";
    mrpt::obs::CRawlog log;
    ASSERT_TRUE(log.loadFromRawLogFile(shipped.string()));
    log.remove(3000, log.size() - 1);
    for (std::size_t i = 0; i < log.size(); ++i) {
        const auto picture =
            std::dynamic_pointer_cast<mrpt::obs::CObservationImage>(log.getAsObservation(i));
        if (!picture) continue;
        auto& camera = picture->cameraParams;
        camera.fx(factor * camera.fx());
        camera.fy(factor * camera.fy());
    }
    ASSERT_TRUE(log.saveToRawLogFile(copy.string()));
    const auto beside = [](fs::path file, const std::string& end) {
        return file.replace_extension().string() + end;
    };
    fs::copy(beside(shipped, ".salient.rawlog"), beside(copy, ".salient.rawlog"));
    fs::create_directory_symlink(beside(shipped, "_Images"), beside(copy, "_Images"));
}

std::string outputWithFocalLength(double factor) {
    const test::CTemporaryFolder folder;
    copyWithFocalLength(factor, folder / "log.rawlog");
    const auto result =
        test::runProcess({test::program("salma-slam"), SALMA_SOURCE_DIR "/config.ini",
                          (folder / "log.rawlog").string(), "--out", (folder / "out").string()});
    EXPECT_EQ(result.exitCode, 0) << result.output;
    EXPECT_NE(result.output.find("salient landmarks, "), std::string::npos) << result.output;
    return result.output;
}

TEST(SalmaSlam, SaysThatTheFocalLengthOfTheLogIsWrong) {
    const std::string right = outputWithFocalLength(1);
    EXPECT_EQ(right.find("focal length"), std::string::npos) << right;
    const std::string wrong = outputWithFocalLength(1.08);
    EXPECT_NE(wrong.find("notice: the focal length in the log seems to be "), std::string::npos)
        << wrong;
    EXPECT_NE(wrong.find(" too long, by the bearings of "), std::string::npos) << wrong;
}

}  // namespace
}  // namespace salma
