// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationImage.h>
#include <salma/sensing/CFrontEndWorker.h>

#include <chrono>
#include <opencv2/core.hpp>

namespace salma::sensing {
namespace {

/// A job without walls, its picture of `cols` x `rows`; the camera takes 640 x 480.
TDecidedPicture job(int cols = 640, int rows = 480, double focalLength = 700) {
    TDecidedPicture decided;
    decided.job.picture = mrpt::obs::CObservationImage::Create();
    auto& picture = *decided.job.picture;
    picture.sensorLabel = "CAMERA";
    if (cols > 0)
        picture.image =
            mrpt::img::CImage(cv::Mat(rows, cols, CV_8UC1, cv::Scalar(0)), mrpt::img::DEEP_COPY);
    picture.cameraParams.ncols = 640;
    picture.cameraParams.nrows = 480;
    picture.cameraParams.setIntrinsicParamsFromValues(focalLength, focalLength, 320, 240);
    decided.job.scan = mrpt::obs::CObservation2DRangeScan::Create();
    return decided;
}

/// The one picture that the worker finishes within a minute.
TWorkedPicture finished(CFrontEndWorker& worker) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (std::chrono::steady_clock::now() < end) {
        auto all = worker.take();
        if (!all.empty()) return std::move(all.front());
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ADD_FAILURE() << "nothing was finished";
    return {};
}

TEST(CFrontEndWorker, KeepsTheNewestOfThePicturesThatWait) {
    CFrontEndWorker nobodyWorks({}, "", 0);
    EXPECT_TRUE(nobodyWorks.isIdle());
    EXPECT_TRUE(nobodyWorks.offer(job()));
    EXPECT_FALSE(nobodyWorks.offer(job())) << "the first was dropped";
    EXPECT_FALSE(nobodyWorks.offer(job()));
    EXPECT_FALSE(nobodyWorks.isIdle());
    EXPECT_TRUE(nobodyWorks.take().empty());
}

TEST(CFrontEndWorker, MakesARecordWithoutLandmarksOfABlackPicture) {
    CFrontEndWorker worker({}, "", 1);
    worker.offer(job());
    const auto worked = finished(worker);
    ASSERT_TRUE(worked.recorded.record) << worked.error;
    EXPECT_TRUE(worked.recorded.record->landmarks.empty());
    EXPECT_EQ(worked.recorded.record->sensorLabel, "CAMERA_SALIENT");
    EXPECT_EQ(worked.recorded.result.refused.at("picture without region"), 1u);
}

TEST(CFrontEndWorker, SaysWhatIsWrongWithABadPictureAndGoesOn) {
    CFrontEndWorker worker({}, "", 1);
    const auto errorOf = [&](TDecidedPicture picture) {
        worker.offer(std::move(picture));
        const auto worked = finished(worker);
        EXPECT_FALSE(worked.recorded.record);
        EXPECT_TRUE(worked.picture.job.picture);
        return worked.error;
    };
    EXPECT_NE(errorOf(job(320, 240)).find("320"), std::string::npos) << "of another size";
    EXPECT_NE(errorOf(job(0, 0)).find("is empty"), std::string::npos);
    EXPECT_NE(errorOf(job(640, 480, 0)).find("no focal length"), std::string::npos);
    auto external = job();
    external.job.picture->image.setExternalStorage("not-there.jpg");
    EXPECT_NE(errorOf(external).find("not-there.jpg: no such picture"), std::string::npos);
    worker.offer(job());
    EXPECT_TRUE(finished(worker).recorded.record);
    EXPECT_TRUE(worker.isIdle());
}

TEST(CFrontEndWorker, RefusesOptionsThatAreOutOfRange) {
    landmarks::TRecorderOptions options;
    options.seeing.frontEnd.minSize = 5;  // above the largest
    EXPECT_THROW(CFrontEndWorker(options, "", 1), std::invalid_argument);
}

}  // namespace
}  // namespace salma::sensing
