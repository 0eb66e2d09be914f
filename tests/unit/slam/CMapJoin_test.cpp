// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/slam/CMapJoin.h>
#include <salma/slam/rangeBearingModel.h>

#include <algorithm>
#include <map>
#include <vector>

#include "CTestWorld.h"

namespace salma::slam {
namespace {

constexpr int kFresh = 1000;  // added to the ids of what is seen in the second half

/// A path of which the second half made all landmarks anew.
class CTornMap {
 public:
    CTornMap() {
        test::CTestWorld world(3);
        Eigen::Vector3d pose(0, 0, 0);
        std::map<int, Eigen::Vector2d> places;
        for (int k = 0; k < 40; ++k) {
            const TStepInput input = world.next();
            TPastStep step;
            step.increment << input.increment.mean.x(), input.increment.mean.y(),
                input.increment.mean.phi();
            step.Q = input.increment.cov.asEigen();
            step.pose = pose = moved(pose, step.increment).pose;
            for (auto m : input.measurements) {
                *m.identity += k < 20 ? 0 : kFresh;
                if (places.insert({*m.identity, located(pose, m.z).landmark}).second)
                    landmarks.add(m, 0);
                step.used.push_back({*m.identity, m.z, m.R});
            }
            history.add(step);
        }
        mean.resize(3 + 2 * static_cast<Eigen::Index>(landmarks.size()));
        mean.head<3>() = pose;
        for (std::size_t i = 0; i < landmarks.size(); ++i)
            mean.segment<2>(3 + 2 * static_cast<Eigen::Index>(i)) = places.at(landmarks[i].id);
    }

    /// Ids of what both halves saw.
    std::vector<int> shared() const {
        std::vector<int> result;
        const auto steps = history.steps();
        for (const auto& entry : steps)
            if (steps.count(entry.first + kFresh) != 0) result.push_back(entry.first);
        return result;
    }

    TSameLandmark pair(int local, int left) const {
        TSameLandmark result;
        result.local = landmarks.indexOf(local + kFresh);
        result.left = landmarks.indexOf(left);
        return result;
    }

    /// A landmark was somewhat farther away than it was.
    void push(int id, double metres) {
        CPathHistory pushed;
        for (std::size_t k = 0; k < history.size(); ++k) {
            TPastStep step = history[k];
            for (auto& used : step.used)
                if (used.landmark == id) used.z[0] += metres;
            pushed.add(step);
        }
        history = pushed;
    }

    CMapJoin join() const { return {history, landmarks, mean}; }

    CPathHistory history;
    CLandmarkTable landmarks{4, 0.2};
    Eigen::VectorXd mean;
};

TEST(CMapJoin, MakesOneOfWhatIsOne) {
    const CTornMap torn;
    const std::vector<int> shared = torn.shared();
    ASSERT_GE(shared.size(), 5u);
    TAlignment alignment;
    for (const int id : shared) alignment.pairs.push_back(torn.pair(id, id));
    const auto joined = torn.join().fitting(alignment, false);
    ASSERT_TRUE(joined);
    EXPECT_EQ(alignment.pairs.size(), shared.size());
    EXPECT_EQ(joined->landmarks.size(), torn.landmarks.size() - shared.size());
    EXPECT_EQ(joined->indexOf(shared[0] + kFresh), joined->indexOf(shared[0]));
    const TLaidMaps laid = torn.join().laid(*joined);
    EXPECT_EQ(laid.landmarks.size(), torn.landmarks.size());
    const auto placeOf = [&](int id) -> Eigen::Vector2d {
        return laid.mean.segment<2>(3 + 2 * static_cast<Eigen::Index>(torn.landmarks.indexOf(id)));
    };
    EXPECT_EQ(placeOf(shared[0]), placeOf(shared[0] + kFresh));
    EXPECT_GT((placeOf(shared[0]) - placeOf(shared[1])).norm(), 0.1);
}

TEST(CMapJoin, LeavesOutWhatDoesNotFitAndRefusesWhatDoesNotAtAll) {
    const CTornMap torn;
    const std::vector<int> shared = torn.shared();
    // One landmark of the second half stands beside the place where the first half has another one.
    TAlignment alignment, wrong;
    for (std::size_t i = 1; i < shared.size(); ++i)
        alignment.pairs.push_back(torn.pair(shared[i], shared[i]));
    const std::size_t right = alignment.pairs.size();
    CTornMap moved = torn;
    moved.push(shared[0] + kFresh, 0.6);
    alignment.pairs.push_back(torn.pair(shared[0], shared[0]));
    const auto joined = moved.join().fitting(alignment, false);
    ASSERT_TRUE(joined);
    EXPECT_EQ(alignment.pairs.size(), right);
    EXPECT_EQ(joined->keptOf.count(shared[0] + kFresh), 0u);
    for (std::size_t i = 0; i < shared.size(); ++i)
        wrong.pairs.push_back(torn.pair(shared[i], shared[(i + 1) % shared.size()]));
    EXPECT_FALSE(torn.join().fitting(wrong, false));
}

}  // namespace
}  // namespace salma::slam
