// SPDX-License-Identifier: BSD-3-Clause
#include <CTemporaryFolder.h>
#include <gtest/gtest.h>
#include <salma/viz/TTrajectory.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace salma::viz {
namespace {

std::string errorOf(const std::string& text) {
    const test::CTemporaryFolder folder;
    const std::string file = folder.write("a.tum", text);
    try {
        readTum(file);
    } catch (const std::invalid_argument& e) {
        const std::string what = e.what();
        return what.substr(what.find("a.tum"));
    }
    return "";
}

TEST(TTrajectory, ReadsAPoseOnThePlaneFromTheQuaternion) {
    const test::CTemporaryFolder folder;
    const std::string file = folder.write(
        "a.tum", "# comment\n\n 1.5\t2 -3 9 0 0 0.70710678 0.70710678\r\n2.5 0 0 0 0 0 1 0\n");
    const auto trajectory = readTum(file);
    ASSERT_EQ(trajectory.size(), 2U);
    EXPECT_EQ(trajectory[0].time, 1.5);
    EXPECT_EQ(trajectory[0].T_w_r.x(), 2);
    EXPECT_EQ(trajectory[0].T_w_r.y(), -3);
    EXPECT_NEAR(trajectory[0].T_w_r.phi(), M_PI / 2, 1e-7);
    EXPECT_NEAR(std::abs(trajectory[1].T_w_r.phi()), M_PI, 1e-12);
}

TEST(TTrajectory, KeepsEqualStampsAndTheirOrder) {
    EXPECT_EQ(errorOf("1 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n"), "");
}

TEST(TTrajectory, NamesFileLineAndProblem) {
    const std::string good = "1 0 0 0 0 0 0 1\n";
    EXPECT_EQ(errorOf(good + "2 0 0 0 0 0 0\n"),
              "a.tum:2: holds 7 of the 8 numbers t x y z qx qy qz qw");
    EXPECT_EQ(errorOf(good + "2 0 0 0 0 0 0 1 5\n"), "a.tum:2: holds more than 8 numbers");
    EXPECT_EQ(errorOf("#\n1 0 nan 0 0 0 0 1\n"), "a.tum:2: 'nan' is not a finite number");
    EXPECT_EQ(errorOf("1 0 1e999 0 0 0 0 1\n"), "a.tum:1: '1e999' is not a finite number");
    EXPECT_EQ(errorOf("1 0 1,5 0 0 0 0 1\n"), "a.tum:1: '1,5' is not a finite number");
    EXPECT_EQ(errorOf("1 0 0 0 0 0 0 0\n"), "a.tum:1: the quaternion has not length 1");
    EXPECT_EQ(errorOf(good + "0.5 0 0 0 0 0 0 1\n"),
              "a.tum:2: the stamp is smaller than the one before");
    EXPECT_EQ(errorOf("# nothing\n"), "a.tum: holds no pose");
}

TEST(TTrajectory, RefusesAMissingFileAndAFolder) {
    EXPECT_THROW(readTum("no-such.tum"), std::runtime_error);
    EXPECT_THROW(readTum("/"), std::runtime_error);
}

TEST(TTrajectory, ReadsBackWhatItWrites) {
    const test::CTemporaryFolder folder;
    const std::string file = (folder / "a.tum").string();
    const TTrajectory written{{1.1e9 + 0.123456, {12.3456789, -0.000123456789, 3.0}},
                              {1.1e9 + 0.123456, {-1, 2, -3.1}}};
    writeTum(written, file);
    const auto read = readTum(file);
    ASSERT_EQ(read.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_NEAR(read[i].time, written[i].time, 5e-7);
        EXPECT_NEAR(read[i].T_w_r.x(), written[i].T_w_r.x(), 1e-7);
        EXPECT_NEAR(read[i].T_w_r.y(), written[i].T_w_r.y(), 1e-12);
        EXPECT_NEAR(read[i].T_w_r.phi(), written[i].T_w_r.phi(), 1e-7);
    }
}

TEST(TTrajectory, TakesOrRefusesAnyDamagedFileWithoutCrashing) {
    const std::string good =
        "# t x y z qx qy qz qw\n1.25 0.5 -1 0 0 0 0 1\n2.5 1 2 0 0 0 0.6 0.8\n3 1 2 0 0 0 -1 0\n";
    const test::CTemporaryFolder folder;
    std::mt19937 random(5);
    std::size_t refused = 0;
    for (int i = 0; i < 400; ++i) {
        std::string text = good;
        for (int k = 0; k < 1 + i % 3; ++k)
            text[random() % text.size()] = static_cast<char>(random() % 256);
        if (i % 4 == 0) text.resize(random() % text.size());
        try {
            for (const auto& [time, pose] : readTum(folder.write("a.tum", text)))
                EXPECT_TRUE(std::isfinite(time + pose.x() + pose.y() + pose.phi())) << text;
        } catch (const std::invalid_argument& e) {
            EXPECT_NE(std::string(e.what()).find("a.tum:"), std::string::npos) << e.what();
            ++refused;
        }
    }
    EXPECT_GT(refused, 100U);
}

}  // namespace
}  // namespace salma::viz
