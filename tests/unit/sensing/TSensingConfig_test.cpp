// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <messages.h>
#include <salma/sensing/TSensingConfig.h>

#include <stdexcept>

#include "CTemporaryFolder.h"
#include "TSlamConfig.h"

namespace salma::sensing {
namespace {

using salma::test::contains;

std::string complaint(const std::string& ini) {
    const test::CTemporaryFolder folder;
    try {
        TSensingConfig::load(folder.write("my.ini", ini));
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

TEST(TSensingConfig, ReadsAConfigOfSalmaSlam) {
    const test::CTemporaryFolder folder;
    apps::TSlamConfig slam;
    slam.lines.inlier = 0.041;
    slam.seeing.frontEnd.minKeypoints = 17;
    slam.seeing.descriptor.contrastThreshold = 0.021;
    slam.tracking.minViews = 3;
    slam.matcher.minMatches = 9;
    const auto file = folder.write("slam.ini", slam.asIni());
    const auto seeing = TSensingConfig::load(file);
    EXPECT_EQ(seeing.recorder.lines.inlier, 0.041);
    EXPECT_EQ(seeing.recorder.seeing.frontEnd.minKeypoints, 17);
    EXPECT_EQ(seeing.recorder.seeing.descriptor.contrastThreshold, 0.021);
    EXPECT_EQ(seeing.tracking.minViews, 3);
    EXPECT_EQ(seeing.matcher.minMatches, 9);
}

TEST(TSensingConfig, ReadsTheShippedConfigAndItsDefaultsAreThose) {
    const auto shipped = TSensingConfig::load(SALMA_SOURCE_DIR "/config.ini");
    const TSensingConfig defaults;
    EXPECT_EQ(shipped.recorder.lines.asIni("a"), defaults.recorder.lines.asIni("a"));
    EXPECT_EQ(shipped.recorder.placeString.asIni("a"), defaults.recorder.placeString.asIni("a"));
    EXPECT_EQ(shipped.recorder.seeing.selection.asIni("a"),
              defaults.recorder.seeing.selection.asIni("a"));
    EXPECT_EQ(shipped.tracking.asIni("a"), defaults.tracking.asIni("a"));
}

TEST(TSensingConfig, NamesWhatIsWrong) {
    EXPECT_TRUE(contains(complaint("[front_ent]\n"), "my.ini: unknown sections: [front_ent]"));
    EXPECT_TRUE(contains(complaint("[front_end]\nmin_keypoint = 3\n"), "unknown keys"));
    EXPECT_TRUE(contains(complaint("[selection]\ndetector = sift\n"), "detector"));
    EXPECT_TRUE(contains(complaint("[lines]\ninlier_m = -1\n"), "is outside"));
    EXPECT_TRUE(contains(complaint("hello\n"), "my.ini:1"));
    EXPECT_THROW(TSensingConfig::load("/no/such.ini"), std::invalid_argument);
}

}  // namespace
}  // namespace salma::sensing
