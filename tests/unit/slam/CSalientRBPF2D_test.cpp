// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/random/RandomGenerators.h>
#include <salma/slam/CSalientRBPF2D.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "CTestWorld.h"

namespace salma::slam {
namespace {

using association::EVerdict;

TRbpfOptions options(int particles, EParticleAlgorithm algorithm = EParticleAlgorithm::standard) {
    TRbpfOptions result;
    result.particles = particles;
    result.algorithm = algorithm;
    result.weightPower = 1;  // the noise of the test world is what its measurements state
    return result;
}

TLandmarkMapSetup setup(bool ignoreIdentities) {
    TLandmarkMapSetup result;
    result.map.ignoreIdentities = ignoreIdentities;
    return result;
}

struct TOutcome {
    TRunRecord record;
    double rms{0};          //!< Of the path [m].
    double odometryRms{0};  //!< Of the increments alone [m].
};

/// A lap and a half of the square.
TOutcome drive(const TRbpfOptions& rbpf, const TLandmarkMapSetup& maps, std::uint32_t seed) {
    test::CTestWorld world(seed);
    CSalientRBPF2D filter(rbpf, maps);
    TOutcome result;
    std::vector<Eigen::Vector3d> truth;
    Eigen::Vector3d odometry(0, 0, 0);
    for (int k = 0; k < 120; ++k) {
        const TStepInput step = world.next();
        filter.process(step);
        truth.push_back(world.pose());
        const auto& mean = step.increment.mean;
        odometry = moved(odometry, {mean.x(), mean.y(), mean.phi()}).pose;
        result.odometryRms += (odometry - truth.back()).head<2>().squaredNorm();
    }
    filter.results(result.record);
    EXPECT_EQ(result.record.trajectory.size(), truth.size());
    for (std::size_t k = 0; k < truth.size(); ++k) {
        const auto& pose = result.record.trajectory[k].pose;
        result.rms += (Eigen::Vector2d(pose.x(), pose.y()) - truth[k].head<2>()).squaredNorm();
    }
    result.rms = std::sqrt(result.rms / 120);
    result.odometryRms = std::sqrt(result.odometryRms / 120);
    return result;
}

TEST(CSalientRBPF2D, MapsWithEveryAlgorithm) {
    for (const auto algorithm :
         {EParticleAlgorithm::standard, EParticleAlgorithm::auxiliary,
          EParticleAlgorithm::auxiliaryOptimal, EParticleAlgorithm::measured}) {
        TRbpfOptions rbpf = options(30, algorithm);
        rbpf.samples = 10;
        const TOutcome outcome = drive(rbpf, setup(false), 1);
        std::cout << "algorithm " << static_cast<int>(algorithm) << ": path " << outcome.rms
                  << " m, odometry alone " << outcome.odometryRms << " m" << std::endl;
        EXPECT_LT(outcome.rms, 0.5 * outcome.odometryRms);
        for (const auto& row : outcome.record.associations)
            EXPECT_NE(row.decision, EDecision::clutter);
    }
}

TEST(CSalientRBPF2D, TellsLandmarksApartByGeometry) {
    double sum = 0, odometry = 0;
    std::size_t landmarks = 0;  // the world has 30, of which not all are seen
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        const TOutcome outcome = drive(options(60), setup(true), seed);
        sum += outcome.rms;
        odometry += outcome.odometryRms;
        landmarks += outcome.record.landmarks.size();
    }
    std::cout << "path " << sum / 4 << " m, odometry alone " << odometry / 4 << " m" << std::endl;
    EXPECT_LT(sum, 0.5 * odometry);
    EXPECT_LE(landmarks, 4u * 36u);
}

TEST(CSalientRBPF2D, FollowsThePathMoreCloselyWhereMeasurementsMoveTheParticles) {
    double byOdometry = 0, byMeasurements = 0;
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
        byOdometry += drive(options(30), setup(true), seed).rms / 3;
        byMeasurements +=
            drive(options(30, EParticleAlgorithm::measured), setup(true), seed).rms / 3;
    }
    std::cout << "path " << byOdometry << " m by odometry, " << byMeasurements
              << " m by measurements too" << std::endl;
    EXPECT_LT(byMeasurements, 0.7 * byOdometry);
}

TEST(CSalientRBPF2D, CountsAndMendsWeightsThatAreNoneOrNoNumbers) {
    for (const auto algorithm : {EParticleAlgorithm::standard, EParticleAlgorithm::measured}) {
        CSalientRBPF2D filter(options(4, algorithm), setup(true));
        test::CTestWorld world(1);
        for (int k = 0; k < 5; ++k) filter.process(world.next());
        // Only MRPT's own programs can do this; a test may stand for them.
        auto& particles =
            const_cast<mrpt::maps::CMultiMetricMapPDF&>(filter.particles()).m_particles;
        for (auto& particle : particles) particle.log_w = -std::numeric_limits<double>::infinity();
        filter.process(world.next());
        EXPECT_EQ(filter.refusedWeights(), 4u);
        particles[1].log_w = std::numeric_limits<double>::quiet_NaN();
        filter.process(world.next());
        EXPECT_EQ(filter.refusedWeights(), 5u);
        EXPECT_TRUE(filter.pose().cov.asEigen().allFinite());
        EXPECT_TRUE(std::isfinite(filter.pose().mean.x()));
        for (const auto& particle : particles) EXPECT_TRUE(std::isfinite(particle.log_w));
        TRunRecord record;
        filter.results(record);
        EXPECT_EQ(record.refused.size(), 1u);
    }
}

TEST(CSalientRBPF2D, GivesTheSameForTheSameSeed) {
    const TOutcome a = drive(options(10), setup(true), 2);
    mrpt::random::getRandomGenerator().drawGaussian1D_normalized();  // odd numbers drawn between
    const TOutcome b = drive(options(10), setup(true), 2);
    ASSERT_EQ(a.record.associations.size(), b.record.associations.size());
    for (std::size_t k = 0; k < a.record.trajectory.size(); ++k)
        ASSERT_EQ(a.record.trajectory[k].pose, b.record.trajectory[k].pose);
    TRbpfOptions other = options(10);
    other.seed = 2;
    const TOutcome c = drive(other, setup(true), 2);
    EXPECT_NE(a.record.trajectory.back().pose, c.record.trajectory.back().pose);
}

TEST(CSalientRBPF2D, RecordsTheAssociationsOfOneLineOfParticles) {
    const TOutcome outcome = drive(options(40), setup(true), 3);
    const auto& record = outcome.record;
    std::size_t measurements = 0;
    test::CTestWorld world(3);
    for (int k = 0; k < 120; ++k) measurements += world.next().measurements.size();
    EXPECT_EQ(record.associations.size(), measurements) << "one row each, in the order of time";
    std::map<int, std::size_t> sightings;
    double time = 0;
    for (const auto& row : record.associations) {
        EXPECT_GE(row.time, time);
        time = row.time;
        if (row.landmark >= 0) ++sightings[row.landmark];
    }
    for (const auto& landmark : record.landmarks)
        EXPECT_EQ(sightings[landmark.id], landmark.sightings) << "of the map at the end";
    const auto paired =
        std::count_if(record.associations.begin(), record.associations.end(), [](const auto& row) {
            return row.decision == EDecision::paired ||
                   (row.decision == EDecision::provisional && !std::isnan(row.distance2));
        });
    EXPECT_EQ(record.innovations.size(), 2 * static_cast<std::size_t>(paired));
    EXPECT_GE(record.candidates.size(), static_cast<std::size_t>(paired));
}

TEST(CSalientRBPF2D, SurvivesStepsWithoutMeasurementAndRefusesUnsoundOnes) {
    for (const auto algorithm : {EParticleAlgorithm::standard, EParticleAlgorithm::measured}) {
        CSalientRBPF2D filter(options(5, algorithm), setup(true));
        TStepInput step;
        step.increment.mean = {1, 0, 0};
        step.increment.cov.setDiagonal(1e-4);
        filter.process(step);
        EXPECT_NEAR(filter.pose().mean.x(), 1, 0.1);
        step.increment.cov.setDiagonal(0);
        filter.process(step);  // at rest as the log sees it, or known exactly
        EXPECT_NEAR(filter.pose().mean.x(), 2, 0.1);
        association::TMeasurement wild;
        wild.z = {std::numeric_limits<double>::quiet_NaN(), 0};
        step.measurements = {wild};
        filter.process(step);
        EXPECT_TRUE(std::isfinite(filter.pose().mean.x()));
        TRunRecord record;
        filter.results(record);
        EXPECT_EQ(record.trajectory.size(), 3u);
        EXPECT_TRUE(record.landmarks.empty());
        ASSERT_EQ(record.associations.size(), 1u);
        EXPECT_EQ(record.associations[0].decision, EDecision::clutter);
        step.increment.mean = {std::numeric_limits<double>::infinity(), 0, 0};
        EXPECT_THROW(filter.process(step), std::invalid_argument);
    }
    TRbpfOptions none;
    none.particles = 0;
    EXPECT_THROW(CSalientRBPF2D(none, {}), std::invalid_argument);
}

}  // namespace
}  // namespace salma::slam
