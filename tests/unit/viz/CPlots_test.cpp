// SPDX-License-Identifier: BSD-3-Clause
#include <CEnvironmentVariable.h>
#include <CTemporaryFolder.h>
#include <gtest/gtest.h>
#include <salma/viz/CPlots.h>

#include <algorithm>
#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "exampleRun.h"

namespace salma::viz {
namespace {

/// Pixels of about this colour, given as red, green, blue.
int countColour(const cv::Mat& picture, const cv::Vec3b& rgb) {
    cv::Mat mask;
    const cv::Scalar centre(rgb[2], rgb[1], rgb[0]);
    cv::inRange(picture, centre - cv::Scalar::all(12), centre + cv::Scalar::all(12), mask);
    return cv::countNonZero(mask);
}

const cv::Vec3b kGreen(0x2c, 0xa0, 0x2c), kBlue(0x1f, 0x5f, 0xd0), kOrange(0xff, 0x98, 0x00),
    kBoundRed(0xd6, 0x27, 0x28);

cv::Mat mapOf(const TReportInput& input) {
    const test::CTemporaryFolder folder;
    plotMap(input, (folder / "map.png").string());
    return cv::imread((folder / "map.png").string());
}

cv::Mat innovationsOf(const slam::TRunRecord& record) {
    const test::CTemporaryFolder folder;
    plotInnovations(record, (folder / "i.png").string());
    return cv::imread((folder / "i.png").string());
}

TEST(CPlots, DrawsTheMapInTheSizeAndColoursOfTheDesign) {
    const auto run = test::hallwayRun();
    const cv::Mat map = mapOf({run.record, run.truth});
    ASSERT_EQ(map.size(), cv::Size(1600, 1200));
    EXPECT_GT(countColour(map, kGreen), 1000);
    EXPECT_GT(countColour(map, kBlue), 1000);
    EXPECT_GT(countColour(map, kOrange), 100) << "the true path";
}

TEST(CPlots, ColoursTheEllipsesByWhatWasSeen) {
    auto run = test::hallwayRun();
    run.record.landmarks.clear();
    const int mixed = countColour(mapOf({run.record, {}}), kBlue);
    for (auto& row : run.record.trajectory) row.sight = slam::ESight::nothing;
    const cv::Mat map = mapOf({run.record, {}});
    EXPECT_GT(mixed, 1000);
    EXPECT_EQ(countColour(map, kBlue), 0);
    EXPECT_GT(countColour(map, kGreen), 1000);
    EXPECT_EQ(countColour(map, kOrange), 0) << "no truth was given";
}

TEST(CPlots, DrawsBothAxesToOneScale) {
    // A square path of 10 m: its black line must be as high as it is wide.
    slam::TRunRecord record;
    const double corners[5][2] = {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}};
    for (const auto& [x, y] : corners) {
        record.trajectory.emplace_back();
        record.trajectory.back().pose = mrpt::poses::CPose2D(x, y, 0);
    }
    cv::Mat black;
    const cv::Mat map = mapOf({record, {}});
    const cv::Rect inside(90, 80, 1460, 900);  // without title, axes and legend
    cv::inRange(map(inside), cv::Scalar::all(0), cv::Scalar::all(40), black);
    std::vector<cv::Point> points;
    cv::findNonZero(black, points);
    int left = 9999, right = 0, top = 9999, bottom = 0;
    for (const auto& p : points) {
        left = std::min(left, p.x);
        right = std::max(right, p.x);
        top = std::min(top, p.y);
        bottom = std::max(bottom, p.y);
    }
    EXPECT_GT(right - left, 600);
    EXPECT_NEAR(right - left, bottom - top, 12) << "up to the dot at the start";
}

TEST(CPlots, LeavesGapsWhereNothingKnownWasSeen) {
    // 100 s with one innovation a second, except from 30 s to 70 s.
    slam::TRunRecord record;
    for (int t = 0; t <= 100; ++t) {
        record.trajectory.emplace_back();
        record.trajectory.back().time = t;
        if (t > 30 && t < 70) continue;
        record.innovations.push_back({double(t), "range_m", 0.01, 0.1});
    }
    const cv::Mat plot = innovationsOf(record);
    ASSERT_EQ(plot.size(), cv::Size(1600, 1000));
    const int left = 112, width = 1456;  // the panel, 0.07 to 0.98 of the picture
    const cv::Rect gap(left + width * 33 / 100, 60, width * 34 / 100, 350);
    const cv::Rect seen(left + width * 5 / 100, 60, width * 20 / 100, 350);
    EXPECT_EQ(countColour(plot(gap), kBoundRed), 0);
    EXPECT_EQ(countColour(plot(gap), kBlue), 0);
    EXPECT_GT(countColour(plot(seen), kBoundRed), 500);
    EXPECT_GT(countColour(plot(seen), kBlue), 50);
}

TEST(CPlots, SpreadsInnovationsOutWhereStampsDoNotTellTheStepsApart) {
    slam::TRunRecord record;
    for (int i = 0; i < 100; ++i) {
        record.trajectory.emplace_back();
        record.trajectory.back().time = 5;
        record.innovations.push_back({5, "range_m", 0.01, 0.1});
        record.innovations.push_back({5, "bearing_deg", 0.01, 0.1});
    }
    const cv::Mat plot = innovationsOf(record);
    for (int part = 0; part < 4; ++part)
        EXPECT_GT(countColour(plot(cv::Rect(130 + part * 350, 60, 350, 350)), kBlue), 100) << part;
}

TEST(CPlots, DrawsAnEmptyRunAndASingleStep) {
    slam::TRunRecord record;
    EXPECT_EQ(mapOf({record, {}}).size(), cv::Size(1600, 1200));
    EXPECT_EQ(innovationsOf(record).size(), cv::Size(1600, 1000));
    record.trajectory.resize(1);
    EXPECT_EQ(mapOf({record, {}}).size(), cv::Size(1600, 1200));
    EXPECT_EQ(innovationsOf(record).size(), cv::Size(1600, 1000));
}

TEST(CPlots, SaysThatGnuplotIsMissing) {
    const test::CTemporaryFolder folder;
    const test::CEnvironmentVariable path("PATH", folder.path().string());
    try {
        plotMap({slam::TRunRecord{}, {}}, (folder / "map.png").string());
        ADD_FAILURE() << "drew without gnuplot";
    } catch (const std::runtime_error& e) {
        EXPECT_NE(std::string(e.what()).find("gnuplot cannot be started"), std::string::npos);
    }
}

TEST(CPlots, PassesOnWhatGnuplotComplainsAbout) {
    const test::CTemporaryFolder folder;
    folder.write("gnuplot", "#!/bin/sh\necho 'unknown terminal pngcairo' >&2\nexit 1\n");
    std::filesystem::permissions(folder / "gnuplot", std::filesystem::perms::all);
    const test::CEnvironmentVariable path("PATH",
                                          folder.path().string() + ":" + std::getenv("PATH"));
    try {
        plotMap({slam::TRunRecord{}, {}}, (folder / "map.png").string());
        ADD_FAILURE() << "drew with a broken gnuplot";
    } catch (const std::runtime_error& e) {
        EXPECT_NE(std::string(e.what()).find("unknown terminal pngcairo"), std::string::npos);
        EXPECT_NE(std::string(e.what()).find("map.png"), std::string::npos);
    }
}

}  // namespace
}  // namespace salma::viz
