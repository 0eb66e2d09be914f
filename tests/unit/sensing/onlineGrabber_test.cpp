// SPDX-License-Identifier: BSD-3-Clause
// MRPT's rawlog-grabber, as it is installed, with MRPT's own camera, an emulated head and a laser
// that is played: do its records equal those that are made of its log afterwards?
#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>
#include <salma/observations/registerClasses.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "CEmulator.h"
#include "CEviD30.h"
#include "CPictureWork.h"
#include "CProcess.h"
#include "CTemporaryFolder.h"
#include "stockProgram.h"

using namespace salma;
using observations::CObservationSalientLandmarks;

namespace {

namespace fs = std::filesystem;

constexpr auto kCamera =
    "[CAMERA_PARAMS]\nresolution = [640 480]\ncx = 319.5\ncy = 239.5\nfx = 772.55\nfy = 772.55\n"
    "distortion_model = none\n";

/// The drive of two-posters, its pictures renamed as MRPT's camera wants them.
void simulate(const test::CTemporaryFolder& folder) {
    const auto made = test::runProcess({test::program("salma-sim"),
                                        SALMA_SOURCE_DIR "/tests/data/worlds/two-posters.ini",
                                        "--out", (folder / "sim").string()});
    ASSERT_EQ(made.exitCode, 0) << made.output;
    std::vector<fs::path> pictures;
    for (const auto& entry : fs::directory_iterator(folder / "sim/two-posters_Images"))
        pictures.push_back(entry.path());
    std::sort(pictures.begin(), pictures.end());
    fs::create_directory(folder / "pictures");
    for (std::size_t i = 0; i < 40; ++i)
        fs::copy(pictures[i % pictures.size()],
                 folder / ("pictures/img_" + std::to_string(100 + i) + ".jpg"));
}

std::string sections(const test::CTemporaryFolder& folder, const std::string& port) {
    const std::string path = folder.path().string();
    return "[global]\nrawlog_prefix = " + path +
           "/log\nGRABBER_PERIOD_MS = 20\ntime_between_launches = 0\n"
           "[SALIENT]\ndriver = CSalientLandmarkSensor\nprocess_rate = 100\ncamera = CAMERA\n"
           "laser = LASER\nhead = HEAD\nwait_s = 10\ncamera_params = " +
           folder.write("camera.ini", kCamera) +
           "\n[CAMERA]\ndriver = CCameraSensor\nrawlog-grabber-ignore = true\nprocess_rate = 10\n"
           "sensorLabel = CAMERA\ngrabber_type = image_dir\nimage_dir_url = " +
           path +
           "/pictures\nleft_format = img_%03d.jpg\nstart_index = 100\nend_index = 139\n"
           "external_images_format = jpg\n"
           "[LASER]\ndriver = CReplaySensor\nrawlog-grabber-ignore = true\nprocess_rate = 100\n"
           "rawlog = " +
           path +
           "/sim/two-posters.rawlog\nlabel = LASER\nstamps = now\nspeed = 2\n"
           "[HEAD]\ndriver = CPanTiltCameraSensor\nrawlog-grabber-ignore = true\n"
           "process_rate = 10\nsensorLabel = HEAD\nbase_z_m = 1.2\nport = " +
           port + "\n";
}

/// As it is read back: an angle of -0 comes back as 0.
std::string bytesOf(const CObservationSalientLandmarks& record) {
    mrpt::io::CMemoryStream once, twice;
    auto archive = mrpt::serialization::archiveFrom(once);
    archive << record;
    once.Seek(0);
    mrpt::serialization::archiveFrom(twice) << *archive.ReadObject<CObservationSalientLandmarks>();
    return {static_cast<const char*>(twice.getRawBufferData()),
            static_cast<std::size_t>(twice.getTotalBytesCount())};
}

/// Takes the front end's records out of a log.
std::vector<CObservationSalientLandmarks::Ptr> takeRecords(observations::TLog& log) {
    std::vector<CObservationSalientLandmarks::Ptr> records;
    for (auto& step : log.steps) {
        auto& all = step.observations;
        for (const auto& o : all)
            if (auto record = std::dynamic_pointer_cast<CObservationSalientLandmarks>(o))
                records.push_back(record);
        all.erase(
            std::remove_if(all.begin(), all.end(),
                           [](const auto& o) {
                               return !!std::dynamic_pointer_cast<CObservationSalientLandmarks>(o);
                           }),
            all.end());
    }
    return records;
}

}  // namespace

TEST(OnlineGrabber, WritesTheRecordsThatSalmaSlamMakesOfItsLog) {
    if (std::system("command -v rawlog-grabber >/dev/null") != 0)
        GTEST_SKIP() << "SKIPPED, rawlog-grabber of package mrpt-apps is not here";
    const test::CTemporaryFolder folder;
    ASSERT_NO_FATAL_FAILURE(simulate(folder));
    const std::string port = (folder / "head").string();
    test::CEviD30 device;
    test::CEmulator emulator(device, port);
    const auto ini = folder.write("grab.ini", sections(folder, port));
    // The last picture ends the grabber, by the exception of MRPT's camera.
    auto command = test::stockProgram("sh", {"-C", folder.path().string()});
    command.insert(command.end(),
                   {"-c", "mkfifo keys; exec rawlog-grabber -p " SALMA_PLUGIN "," SALMA_REPLAY " " +
                              ini + " <> keys"});
    const auto grabbed = test::runProcess(command);
    std::string file;
    for (const auto& entry : fs::directory_iterator(folder.path()))
        if (entry.path().extension() == ".rawlog") file = entry.path().string();
    ASSERT_FALSE(file.empty()) << grabbed.output;
    EXPECT_NE(grabbed.output.find("40 pictures at the end"), std::string::npos) << grabbed.output;
    observations::registerClasses();
    auto log = observations::readLog(file);
    const auto records = takeRecords(log);
    EXPECT_GE(records.size(), 3u) << grabbed.output;
    const apps::TSlamConfig config;
    const auto offLine = apps::CPictureWork(config, log).run();
    std::size_t compared = 0;
    for (const auto& record : records)
        for (const auto& other : offLine.records)
            if (other->timestamp == record->timestamp) {
                EXPECT_TRUE(bytesOf(*record) == bytesOf(*other)) << record->pictureFile;
                ++compared;
            }
    EXPECT_GE(compared, 3u);
}
