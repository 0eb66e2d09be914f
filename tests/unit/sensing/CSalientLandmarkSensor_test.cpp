// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <messages.h>
#include <mrpt/config/CConfigFile.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/serialization/CArchive.h>
#include <salma/drivers/registerSensors.h>
#include <salma/sensing/CSalientLandmarkSensor.h>
#include <salma/sensing/registerSensors.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <thread>

#include "CPictureWork.h"
#include "CProcess.h"
#include "CReplaySensor.h"
#include "CTemporaryFolder.h"

namespace salma::sensing {
namespace {

using salma::test::contains;
using salma::test::messageOf;

using mrpt::obs::CObservation;
using mrpt::obs::CObservationImage;
using observations::CObservationSalientLandmarks;

/// A short simulated log, made once for all tests here.
std::string simulatedLog() {
    static const test::CTemporaryFolder folder;
    static const auto made = test::runProcess(
        {test::program("salma-sim"), SALMA_SOURCE_DIR "/tests/data/worlds/two-posters.ini", "--out",
         (folder / "sim").string()});
    EXPECT_EQ(made.exitCode, 0) << made.output;
    return (folder / "sim/two-posters.rawlog").string();
}

/// The section of a source that plays one label of the simulated log.
std::string source(const std::string& label, const std::string& more = "") {
    std::string log = simulatedLog();
    if (label == "HEAD") log.insert(log.rfind('.'), ".salient");
    return "[" + label + "]\ndriver = CReplaySensor\nprocess_rate = 200\n" +
           "rawlog-grabber-ignore = true\nrawlog = " + log + "\nlabel = " + label + "\n" + more;
}

std::string allSources(const std::string& more = "") {
    return source("CAMERA", more) + source("LASER", more) + source("ODOMETRY", more) +
           source("HEAD", more);
}

constexpr auto kRoles = "camera = CAMERA\nlaser = LASER\nodometry = ODOMETRY\nhead = HEAD\n";

class SalientSensor : public testing::Test {
 protected:
    SalientSensor() {
        test::CReplaySensor::doRegister();
        m_sensor.setMinLoggingLevel(mrpt::system::LVL_ERROR);
    }

    static void load(const std::string& own,
                     const std::string& others,
                     CSalientLandmarkSensor& sensor) {
        sensor.loadConfig(
            mrpt::config::CConfigFileMemory(
                "[SALIENT]\ndriver = CSalientLandmarkSensor\nprocess_rate = 50\n" + own + others),
            "SALIENT");
    }
    void load(const std::string& own, const std::string& others) { load(own, others, m_sensor); }

    /// Lets the sensor work until `done`, a minute at most.
    void runUntil(const std::function<bool()>& done) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
        while (!done() && std::chrono::steady_clock::now() < end) {
            m_sensor.doProcess();
            for (const auto& [time, o] : m_sensor.getObservations())
                m_seen.push_back(std::dynamic_pointer_cast<CObservation>(o));
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        EXPECT_TRUE(done()) << "not within a minute";
    }

    /// Pictures of which is known what became of them.
    std::size_t settled() const {
        std::size_t count = m_sensor.counts().records;
        for (const auto& [reason, n] : m_sensor.counts().dropped) count += n;
        return count;
    }

    template <class T>
    std::vector<typename T::Ptr> seen() const {
        std::vector<typename T::Ptr> some;
        for (const auto& o : m_seen)
            if (const auto one = std::dynamic_pointer_cast<T>(o)) some.push_back(one);
        return some;
    }

    CSalientLandmarkSensor m_sensor;
    std::vector<CObservation::Ptr> m_seen;
};

std::string bytesOf(const CObservationSalientLandmarks& record) {
    mrpt::io::CMemoryStream stream;
    mrpt::serialization::archiveFrom(stream) << record;
    return {static_cast<const char*>(stream.getRawBufferData()),
            static_cast<std::size_t>(stream.getTotalBytesCount())};
}

}  // namespace

TEST_F(SalientSensor, WritesTheRecordsThatSalmaSlamMakesOfTheSameLog) {
    // Three times as fast as it was, and patient, so that a busy machine joins the same.
    load(std::string(kRoles) + "wait_s = 5\nthreads = 2\n", allSources("speed = 3\n"));
    const auto log = observations::readLog(simulatedLog());
    const apps::TSlamConfig config;
    auto offLine = apps::CPictureWork(config, log).run();
    m_sensor.initialize();
    ASSERT_EQ(offLine.pictures, 15u);
    runUntil([&] { return settled() == offLine.pictures; });
    const auto records = seen<CObservationSalientLandmarks>();
    EXPECT_EQ(records.size(), m_sensor.counts().records);
    EXPECT_GE(records.size(), 3u);
    std::size_t landmarks = 0;
    for (const auto& record : records) {
        const auto same =
            std::find_if(offLine.records.begin(), offLine.records.end(),
                         [&](const auto& r) { return r->timestamp == record->timestamp; });
        ASSERT_NE(same, offLine.records.end());
        (*same)->pictureFile = "";  // the replayed pictures are in no file
        EXPECT_TRUE(bytesOf(*record) == bytesOf(**same)) << landmarks;
        landmarks += record->landmarks.size();
    }
    EXPECT_EQ(landmarks, m_sensor.counts().landmarks);
    EXPECT_GE(landmarks, 1u) << "a log that shows something";
    // All that the sources saw is handed on, the pictures with the pose of the head.
    const auto pictures = seen<CObservationImage>();
    EXPECT_EQ(pictures.size(), 15u);
    for (const auto& picture : pictures)
        for (const auto& record : records)
            if (record->timestamp == picture->timestamp) {
                EXPECT_LT(picture->cameraPose.distanceTo(record->cameraPose), 1e-9);
            }
    EXPECT_GT(seen<observations::CObservationPanTilt>().size(), 50u);
    EXPECT_GT(seen<mrpt::obs::CObservationOdometry>().size(), 100u);
}

TEST_F(SalientSensor, DropsWholePicturesWhenTheyComeTooFastAndCountsThem) {
    load(std::string(kRoles) + "wait_s = 5\n", allSources("speed = 20\n"));
    m_sensor.initialize();
    runUntil([&] { return settled() == 15; });
    const auto& counts = m_sensor.counts();
    EXPECT_EQ(seen<CObservationImage>().size(), 15u) << "the log keeps every picture";
    EXPECT_EQ(seen<CObservationSalientLandmarks>().size(), counts.records);
    EXPECT_GE(counts.records, 1u);
    for (const auto& [reason, count] : counts.dropped) EXPECT_EQ(reason, "front end busy");
}

TEST_F(SalientSensor, SaysSoWhereScansOrTheHeadAreMissing) {
    load("camera = CAMERA\nlaser = ODOMETRY\nwait_s = 0\n", allSources("speed = 1000\n"));
    m_sensor.initialize();
    runUntil([&] { return settled() == 15; });
    EXPECT_EQ(m_sensor.counts().dropped.at("no scan within max_skew_s"), 15u);
    EXPECT_EQ(seen<CObservationImage>().size(), 15u);
}

TEST_F(SalientSensor, ReportsASourceThatFailsWhenThePicturesBeforeAreDone) {
    load(
        "camera = CAMERA\nlaser = LASER\nwait_s = 0.1\n",
        source("CAMERA", "speed = 1000\nfail_at_end = true\n") + source("LASER", "speed = 1000\n"));
    m_sensor.initialize();
    EXPECT_EQ(messageOf([&] { runUntil([] { return false; }); }),
              "section (CAMERA): all was played");
    EXPECT_EQ(settled(), 15u);
    EXPECT_EQ(m_sensor.getState(), mrpt::hwdrivers::CGenericSensor::ssError);
}

TEST_F(SalientSensor, ItsSectionsAreReadStrictly) {
    const auto complaint = [&](const std::string& own, const std::string& others) {
        CSalientLandmarkSensor fresh;
        return messageOf([&] { load(own, others, fresh); });
    };
    const std::string both = source("CAMERA") + source("LASER");
    EXPECT_EQ(complaint("camera = CAMERA\nlaser = LASER\n", both), "");
    EXPECT_TRUE(contains(complaint("laser = LASER\n", both), "camera names no section"));
    EXPECT_TRUE(contains(complaint("camera = CAMERA\n", both), "laser names no section"));
    EXPECT_TRUE(contains(complaint("camera = CAMERA\nlaser = SICK\n", both),
                         "section (SICK) is not there"));
    EXPECT_TRUE(contains(complaint("camera = CAMERA\nlaser = LASER\nhead_s = 1\n", both),
                         "(SALIENT) has unknown keys: head_s"));
    EXPECT_TRUE(contains(complaint("camera = CAMERA\nlaser = LASER\nthreads = 0\n", both),
                         "threads = '0'"));
    EXPECT_TRUE(contains(
        complaint("camera = CAMERA\nlaser = L\n", source("CAMERA") + "[L]\ndriver = CNo\n"),
        "section (L) needs rawlog-grabber-ignore = true"));
    EXPECT_TRUE(contains(complaint("camera = CAMERA\nlaser = L\n",
                                   source("CAMERA") + "[L]\ndriver = CNo\nrawlog-grabber-ignore = "
                                                      "true\n"),
                         "section (L) has driver = 'CNo', which is not known"));
    EXPECT_TRUE(contains(complaint("camera = CAMERA\nlaser = LASER\nconfig = no.ini\n", both),
                         "no.ini: no such file"));
    EXPECT_TRUE(contains(complaint("camera = CAMERA\nlaser = LASER\nattend = true\n", both),
                         "attend needs a head"));
    EXPECT_TRUE(contains(complaint("camera = CAMERA\nlaser = LASER\nattend = true\nhead = HEAD\n",
                                   both + source("HEAD")),
                         "section (HEAD) with driver = CPanTiltCameraSensor"));
    const test::CTemporaryFolder folder;
    const auto ini = folder.write("my.ini", "[front_ent]\n");
    EXPECT_TRUE(contains(complaint("camera = CAMERA\nlaser = LASER\nconfig = " + ini + "\n", both),
                         "unknown sections: (front_ent)"));
    EXPECT_TRUE(
        contains(complaint("camera = CAMERA\nlaser = LASER\ncamera_params = " + ini + "\n", both),
                 "has no section (CAMERA_PARAMS)"));
}

TEST_F(SalientSensor, TheShippedSectionsCanBeRead) {
    drivers::registerSensors();
    std::string ini = test::readFile(SALMA_SOURCE_DIR "/share/grabber/salient-landmarks.ini");
    const test::CTemporaryFolder folder;
    const std::string name = "= camera.ini";
    ASSERT_NE(ini.find(name), std::string::npos);
    ini.replace(ini.find(name), name.size(),
                "= " + folder.write("camera.ini",
                                    "[CAMERA_PARAMS]\nresolution = [640 480]\ncx = 320\ncy = "
                                    "240\nfx = 700\nfy = 700\n"));
    EXPECT_EQ(messageOf([&] {
                  m_sensor.loadConfig(mrpt::config::CConfigFile(folder.write("grabber.ini", ini)),
                                      "SALIENT");
              }),
              "");
}

TEST_F(SalientSensor, IsKnownToMrptByItsName) {
    registerSensors();
    const auto sensor = mrpt::hwdrivers::CGenericSensor::createSensorPtr("CSalientLandmarkSensor");
    EXPECT_TRUE(std::dynamic_pointer_cast<CSalientLandmarkSensor>(sensor));
}

TEST_F(SalientSensor, TheSectionThatItPrintsCanBeRead) {
    TSalientSensorOptions options, loaded;
    options.camera = "CAMERA";
    options.laser = "LASER";
    options.threads = 3;
    loaded.loadFromConfigFile(mrpt::config::CConfigFileMemory(options.asIni("SALIENT")), "SALIENT");
    EXPECT_EQ(loaded.asIni("SALIENT"), options.asIni("SALIENT"));
}

}  // namespace salma::sensing
