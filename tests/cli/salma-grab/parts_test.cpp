// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/serialization/CArchive.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "CCaptureFile.h"
#include "CPendingRecords.h"
#include "CPictureWatch.h"
#include "CTemporaryFolder.h"
#include "pictureFault.h"

namespace fs = std::filesystem;
using namespace std::chrono_literals;

namespace salma::apps {
namespace {

mrpt::obs::CObservationComment note(const std::string& text) {
    mrpt::obs::CObservationComment comment;
    comment.text = text;
    return comment;
}

/// Records with these stamps, named by them.
mrpt::hwdrivers::CGenericSensor::TListObservations stamped(const std::vector<int>& stamps) {
    mrpt::hwdrivers::CGenericSensor::TListObservations list;
    for (const int stamp : stamps) {
        auto record = mrpt::obs::CObservationComment::Create();
        record->text = std::to_string(stamp);
        list.emplace(mrpt::Clock::fromDouble(stamp), record);
    }
    return list;
}

std::string textOf(const std::vector<CPendingRecords::TRecord>& records) {
    std::string text;
    for (const auto& record : records)
        text += std::dynamic_pointer_cast<mrpt::obs::CObservationComment>(record)->text + " ";
    return text;
}

cv::Mat noisyPicture() {
    cv::Mat picture(120, 160, CV_8UC1);
    cv::randu(picture, 60, 200);
    return picture;
}

class PictureWatch : public testing::Test {
 protected:
    mrpt::obs::CObservationImage external(const std::string& name, double time) const {
        mrpt::obs::CObservationImage picture;
        picture.sensorLabel = "CAM";
        picture.timestamp = mrpt::Clock::fromDouble(time);
        picture.image.setExternalStorage(name);
        return picture;
    }
    void write(const std::string& name, const cv::Mat& picture) const {
        cv::imwrite((m_folder / name).string(), picture);
    }

    test::CTemporaryFolder m_folder;
    std::vector<std::string> m_told;
    CPictureWatch m_watch{m_folder.path().string(),
                          [this](const std::string& line) { m_told.push_back(line); }};
};

}  // namespace

TEST(CPendingRecords, RecordsWaitForOlderOnesAndLeaveInOrder) {
    CPendingRecords pending;
    const CPendingRecords::TTime start{};
    pending.add(stamped({10, 20}), start);
    pending.add(stamped({15}), start + 100ms);
    pending.add(stamped({30}), start + 200ms);
    EXPECT_EQ(textOf(pending.take(start - 1ms)), "");
    EXPECT_EQ(textOf(pending.take(start)), "10 15 20 ");  // 15 is younger, but older by its stamp
    pending.add(stamped({12}), start + 300ms);            // too late for its place
    EXPECT_EQ(textOf(pending.take(start + 200ms)), "12 30 ");
    EXPECT_EQ(textOf(pending.takeAll()), "");
}

TEST(CPendingRecords, StampsFromAnotherCenturyKeepNothingWaiting) {
    CPendingRecords pending;
    const CPendingRecords::TTime start{};
    pending.add(stamped({1000}), start);
    pending.add(stamped({-50}), start + 100ms);  // the clock jumped back
    EXPECT_EQ(textOf(pending.take(start)), "-50 1000 ");
    pending.add(stamped({-49}), start + 200ms);
    EXPECT_EQ(textOf(pending.take(start + 200ms)), "-49 ");
}

TEST(CCaptureFile, IsWholeAfterEachMember) {
    const test::CTemporaryFolder folder;
    const std::string name = (folder / "x.rawlog").string();
    CCaptureFile file(name, {});
    file.add(note("first"));
    EXPECT_EQ(fs::file_size(name), 0U);
    file.completeMember();
    file.completeMember();  // an empty one adds nothing
    file.add(note("second"));
    file.completeMember();
    file.add(note("not completed"));
    EXPECT_EQ(file.objects(), 2U);
    EXPECT_EQ(fs::file_size(name), file.bytes());
    mrpt::io::CFileGZInputStream in(name);
    auto archive = mrpt::serialization::archiveFrom(in);
    for (const char* text : {"first", "second"}) {
        const auto read = archive.ReadObject<mrpt::obs::CObservationComment>();
        ASSERT_TRUE(read);
        EXPECT_EQ(read->text, text);
    }
    EXPECT_ANY_THROW(archive.ReadObject());
}

TEST(CCaptureFile, TwoProgramsDoNotWriteOneFile) {
    const test::CTemporaryFolder folder;
    const std::string name = (folder / "x.rawlog").string();
    CCaptureFile::TOptions options;
    options.overwrite = true;
    CCaptureFile file(name, options);
    file.add(note("kept"));
    file.completeMember();
    EXPECT_THROW(CCaptureFile(name, options), std::runtime_error);
    EXPECT_EQ(fs::file_size(name), file.bytes());
}

TEST(CPictureWatchFaults, ToldByTheirContent) {
    const cv::Mat good = noisyPicture();
    EXPECT_EQ(faultOf(good), "");
    EXPECT_EQ(faultOf(cv::Mat::zeros(120, 160, CV_8UC1)), "black");
    cv::Mat dark(120, 160, CV_8UC1);
    cv::randu(dark, 0, 15);  // noise of a camera behind its cap
    EXPECT_EQ(faultOf(dark), "black");
    EXPECT_EQ(faultOf(cv::Mat(120, 160, CV_8UC1, cv::Scalar(128))), "of one brightness all over");
    cv::Mat cut = good.clone();
    cut.rowRange(80, 120) = 128;
    EXPECT_EQ(faultOf(cut), "cut: its lower part is missing");
    for (int row = 80; row < 120; ++row) good.row(79).copyTo(cut.row(row));
    EXPECT_EQ(faultOf(cut), "cut: its lower part is missing");
    cv::Mat bars = good.clone();
    for (int row = 1; row < 120; ++row) good.row(0).copyTo(bars.row(row));
    EXPECT_EQ(faultOf(bars), "");
    cv::Mat shadow = good.clone();
    shadow.rowRange(80, 120) = 0;  // a dark floor is no fault
    EXPECT_EQ(faultOf(shadow), "");
    cv::Mat snow = good.clone();
    snow.rowRange(80, 120) = 255;  // nor is a floor that is too bright
    EXPECT_EQ(faultOf(snow), "");
    EXPECT_EQ(faultOf(cv::Mat(1, 1, CV_8UC1, cv::Scalar(200))), "of one brightness all over");
}

TEST_F(PictureWatch, FilesThatAreMissingOrCutAreTold) {
    write("good.jpg", noisyPicture());
    m_watch.look(external("good.jpg", 10));
    EXPECT_TRUE(m_told.empty());
    m_watch.look(external("none.jpg", 10.1));
    m_folder.write("empty.jpg", "");
    m_watch.look(external("empty.jpg", 10.2));
    for (const std::string name : {"good.jpg", "good.png"}) {
        write(name, noisyPicture());
        const std::string whole = test::readFile(m_folder / name);
        m_folder.write("cut" + name, whole.substr(0, whole.size() - 100));
        m_watch.look(external("cut" + name, 10.3));
    }
    m_folder.write("text.jpg", "no picture\xff\xd9");
    m_watch.look(external("text.jpg", 12));
    m_watch.look(external("none.jpg", 13));  // told once, counted twice
    ASSERT_EQ(m_told.size(), 4U);
    EXPECT_EQ(m_told[0], "CAM: a picture is missing: its file was not written (none.jpg)");
    EXPECT_EQ(m_told[1], "CAM: a picture is an empty file (empty.jpg)");
    EXPECT_EQ(m_told[2], "CAM: a picture is cut: its file has no end (cutgood.jpg)");
    EXPECT_EQ(m_told[3], "CAM: a picture is not to be decoded (text.jpg)");
    EXPECT_EQ(m_watch.faults().at("CAM missing: its file was not written"), 2U);
    EXPECT_EQ(m_watch.faults().at("CAM cut: its file has no end"), 2U);
}

TEST_F(PictureWatch, ContentIsLookedAtOnceASecond) {
    write("good.png", noisyPicture());
    write("black.png", cv::Mat::zeros(120, 160, CV_8UC1));
    m_watch.look(external("good.png", 10));
    m_watch.look(external("black.png", 10.5));
    EXPECT_TRUE(m_told.empty());
    m_watch.look(external("black.png", 11.1));
    EXPECT_EQ(m_told.size(), 1U);
    m_watch.look(external("black.png", 5));  // the clock jumped back
    EXPECT_EQ(m_watch.faults().at("CAM black"), 2U);
}

}  // namespace salma::apps
