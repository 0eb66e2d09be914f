// SPDX-License-Identifier: BSD-3-Clause
// MRPT's filters and salma's on MRPT's range-bearing logs, side by side.
#include <gtest/gtest.h>
#include <salmaRun.h>
#include <stockRun.h>

#include <filesystem>

namespace salma::bench {
namespace {

const std::string kShare = "/usr/share/mrpt/";

class KfSlam : public ::testing::Test {
 protected:
    void SetUp() override {
        if (!std::filesystem::exists(kShare + "datasets/kf-slam_demo.rawlog"))
            GTEST_SKIP() << "SKIPPED, not here: the logs of the package mrpt-common";
    }

    static TDemo demo(const std::string& name) { return TDemo::read(kShare + "datasets/" + name); }
    static std::string ini(const std::string& name) {
        return kShare + "config_files/kf-slam/" + name;
    }
    static apps::TSlamConfig config() {
        auto config = apps::TSlamConfig::load(SALMA_SOURCE_DIR "/config.ini");
        config.ekf.ignoreIdentities = true;
        return config;
    }
};

TEST_F(KfSlam, FindsEveryLandmarkOnceWhereMrptMakesDuplicates) {
    const TDemo log = demo("kf-slam_demo");
    const std::string options = ini("EKF-SLAM_test_2d.ini");
    const TDemoScore nn = score(log, runStock2D(log, options, EStockMethod::nn));
    const TDemoScore jcbb = score(log, runStock2D(log, options, EStockMethod::jcbb));
    const TDemoScore ours = score(log, runSalma(log, config()));
    EXPECT_EQ(nn.landmarks, 84u);
    EXPECT_EQ(jcbb.landmarks, 80u);
    EXPECT_EQ(ours.landmarks, 70u);
    EXPECT_EQ(ours.duplicates, 0u);
    EXPECT_LE(ours.pathRms, 0.0065);
}

TEST_F(KfSlam, IsNoWorseThanMrptOnTheAssociationLogInSpace) {
    const TDemo log = demo("kf-slam_6D_demo_DA");
    const std::string options = ini("EKF-SLAM_6D_test_datassoc.ini");
    const TDemoScore jcbb = score(log, runStock3D(log, options, EStockMethod::jcbb));
    auto spatial = config();
    spatial.ekf.state = slam::EState::space;
    for (const auto method : {association::EMethod::nn, association::EMethod::scnn,
                              association::EMethod::jcbb, association::EMethod::saliency}) {
        spatial.association.method = method;
        const TDemoScore ours = score(log, runSalma(log, spatial));
        EXPECT_EQ(ours.landmarks, 20u);
        EXPECT_EQ(ours.duplicates, 0u);
        EXPECT_LE(ours.pathRms, jcbb.pathRms);
    }
}

TEST_F(KfSlam, MakesNoDuplicatesInSpaceWhereMrptDoes) {
    const TDemo log = demo("kf-slam_6D_demo");
    const std::string options = ini("EKF-SLAM_6D_test.ini");
    EXPECT_GT(score(log, runStock3D(log, options, EStockMethod::jcbb)).duplicates, 0u);
    auto spatial = config();
    spatial.ekf.state = slam::EState::space;
    const TDemoScore ours = score(log, runSalma(log, spatial));
    EXPECT_EQ(ours.landmarks, 48u);  // as many as are seen
    EXPECT_EQ(ours.duplicates, 0u);
}

TEST_F(KfSlam, RefusesARunOfAnotherLength) {
    const TDemo log = demo("kf-slam_demo");
    EXPECT_THROW(score(log, TDemoRun{}), std::invalid_argument);
    EXPECT_THROW(TDemo::read("/nowhere/log"), std::runtime_error);
}

}  // namespace
}  // namespace salma::bench
