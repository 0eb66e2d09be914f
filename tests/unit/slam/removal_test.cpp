// SPDX-License-Identifier: BSD-3-Clause
// What is taken off its wall leaves the map, and nothing else does.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "CCorridorWorld.h"

namespace salma::slam {
namespace {

using test::CCorridorWorld;
using test::TCorridorOptions;

struct TDrive {
    TRunRecord record;
    std::map<int, std::map<std::size_t, int>> features;  //!< By landmark, how often it was which.
    std::size_t taken{0};

    /// Landmarks that were mostly this feature.
    std::size_t count(std::size_t feature) const {
        std::size_t result = 0;
        for (const TMapLandmark& landmark : record.landmarks) {
            const auto seen = features.find(landmark.id);
            if (seen == features.end()) continue;
            const auto other = seen->second.find(feature);
            result += other != seen->second.end() && 2 * other->second > total(seen->second);
        }
        return result;
    }

 private:
    static int total(const std::map<std::size_t, int>& seen) {
        int sum = 0;
        for (const auto& entry : seen) sum += entry.second;
        return sum;
    }
};

enum class EGone { nothing, one, all };

/// Two laps; at step 300 what was seen at step 60 is taken down, or everything is.
TDrive drive(double removeAfter, EGone gone) {
    TCorridorOptions options;
    options.seed = 5;
    CCorridorWorld world(options);
    TEkfOptions ekf;
    ekf.removeAfter = removeAfter;
    CSalientEKF2D filter(ekf, {}, CCorridorWorld::ratio);
    TDrive drive;
    for (int k = 0; !world.done(); ++k) {
        filter.process(world.next());
        if (k == 60) drive.taken = world.truth().back();
        if (k == 300 && gone == EGone::one) world.takeDown(drive.taken);
        if (k == 300 && gone == EGone::all)
            for (std::size_t i = 0; i < world.features(); ++i) world.takeDown(i);
    }
    filter.results(drive.record);
    for (std::size_t i = 0; i < drive.record.associations.size(); ++i)
        if (drive.record.associations[i].landmark >= 0)
            ++drive.features[drive.record.associations[i].landmark][world.truth()[i]];
    return drive;
}

TEST(Removal, TakesWhatIsGoneAndNothingElse) {
    const TDrive kept = drive(0, EGone::one), removed = drive(6, EGone::one),
                 whole = drive(6, EGone::nothing);
    EXPECT_EQ(kept.record.removed, 0u);
    EXPECT_EQ(kept.count(kept.taken), 1u);
    EXPECT_EQ(removed.taken, kept.taken);
    EXPECT_EQ(removed.count(removed.taken), 0u);
    EXPECT_EQ(removed.record.removed, 1u);
    EXPECT_EQ(removed.record.landmarks.size() + 1, kept.record.landmarks.size());
    EXPECT_EQ(whole.record.removed, 0u) << "all that hangs is found again";
}

TEST(Removal, WaitsUntilTheRobotKnowsWhereItIs) {
    EXPECT_EQ(drive(2, EGone::all).record.removed, 0u) << "nothing tells it where it is";
}

}  // namespace
}  // namespace salma::slam
