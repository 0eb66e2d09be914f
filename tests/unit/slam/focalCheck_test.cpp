// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/slam/focalCheck.h>

#include <cmath>
#include <random>

namespace salma::slam {
namespace {

using mrpt::poses::CPose2D;

/** Eight posters along a wall, each seen from ten places by a camera that looks 40 degrees to the
 * left, with a focal length that is too long by `error` and 0.1 degrees of noise. */
TRunRecord drive(double error, unsigned seed, double spread = 1) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0, 0.1 * M_PI / 180);
    TRunRecord record;
    for (int id = 0; id < 8; ++id) {
        TMapLandmark landmark;
        landmark.id = id;
        landmark.kind = association::ELandmarkKind::salient;
        landmark.mean = {3.0 * id + 2, 1.5};
        record.landmarks.push_back(landmark);
        for (int k = 0; k < 10; ++k) {
            TTrajectoryRow row;
            row.time = 100 * id + k;
            row.pose = CPose2D(3 * id + spread * 0.12 * k, spread * 0.02 * k, spread * 0.01 * k);
            record.trajectory.push_back(row);
            const double bearing =
                std::atan2(landmark.mean.y - row.pose.y(), landmark.mean.x - row.pose.x()) -
                row.pose.phi();
            const double look = 40 * M_PI / 180;
            const double seen = std::atan(std::tan(look - bearing) / (1 + error));
            TAssociationRow association;
            association.time = row.time;
            association.kind = association::ELandmarkKind::salient;
            association.decision = k == 0 ? EDecision::created : EDecision::paired;
            association.landmark = id;
            association.axisAngle = seen;
            association.bearing = look - seen + noise(random);
            record.associations.push_back(association);
        }
    }
    return record;
}

TEST(CheckFocalLength, FindsTheErrorAndItsSigma) {
    for (const double error : {-0.1, -0.03, 0.03, 0.1})
        for (unsigned seed = 1; seed <= 5; ++seed) {
            const auto check = checkFocalLength(drive(error, seed));
            ASSERT_TRUE(check);
            EXPECT_EQ(check->sightings, 80u);
            // the model is linear in the error: a tenth of it is lost at 10 %
            EXPECT_NEAR(check->error, error, 4 * check->sigma + 0.1 * std::abs(error));
            EXPECT_TRUE(check->isWrong()) << error << " " << check->error << " " << check->sigma;
        }
}

TEST(CheckFocalLength, SaysNothingOfARightOne) {
    double sum2 = 0;
    constexpr int kRuns = 400;
    for (unsigned seed = 1; seed <= kRuns; ++seed) {
        const auto check = checkFocalLength(drive(0, seed));
        ASSERT_TRUE(check);
        EXPECT_FALSE(check->isWrong());
        sum2 += check->error * check->error / (check->sigma * check->sigma);
    }
    EXPECT_NEAR(sum2 / kRuns, 1, 3 * std::sqrt(2.0 / kRuns));  // the sigma is what it says
}

TEST(CheckFocalLength, DoesNotKnowWhereItCannot) {
    EXPECT_FALSE(checkFocalLength({}));
    EXPECT_FALSE(checkFocalLength(drive(0.1, 1, 0)));  // each poster in one column
    auto few = drive(0.1, 1);
    few.associations.resize(19);
    EXPECT_FALSE(checkFocalLength(few));
    auto once = drive(0.1, 1);  // each landmark seen once
    for (std::size_t i = 0; i < once.associations.size(); ++i)
        once.associations[i].landmark = static_cast<int>(i);
    EXPECT_FALSE(checkFocalLength(once));
    auto corners = drive(0.1, 1);
    for (auto& row : corners.associations) row.axisAngle = std::nan("");
    EXPECT_FALSE(checkFocalLength(corners));
}

TEST(CheckFocalLength, DoesNotMindALandmarkInAWrongDirection) {
    auto record = drive(0.03, 1);
    const auto right = checkFocalLength(record);
    for (auto& row : record.associations) row.bearing += 0.02 * (row.landmark % 3 - 1);
    const auto check = checkFocalLength(record);
    ASSERT_TRUE(check && right);
    EXPECT_NEAR(check->error, right->error, 1e-9);
    EXPECT_NEAR(check->sigma, right->sigma, 1e-9);
}

TEST(CheckFocalLength, LeavesOutWhatWasNotPaired) {
    auto record = drive(0, 1);
    const auto sound = checkFocalLength(record);
    for (int k = 0; k < 50; ++k) {
        TAssociationRow wild = record.associations[static_cast<std::size_t>(k)];
        wild.decision = k % 2 == 0 ? EDecision::deferred : EDecision::clutter;
        wild.bearing += 0.2 * k;
        record.associations.push_back(wild);
    }
    const auto check = checkFocalLength(record);
    ASSERT_TRUE(check && sound);
    EXPECT_EQ(check->error, sound->error);
}

}  // namespace
}  // namespace salma::slam
