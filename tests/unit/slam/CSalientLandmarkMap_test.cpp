// SPDX-License-Identifier: BSD-3-Clause

#include <CTemporaryFolder.h>
#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/serialization/CArchive.h>
#include <salma/slam/CSalientLandmarkMap.h>
#include <salma/slam/CSharedParts.h>
#include <salma/slam/registerClasses.h>
#include <salma/slam/salientMeasurement.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <random>

namespace salma::slam {
namespace {

using association::ELandmarkKind;
using association::EVerdict;
using association::TMeasurement;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;

TMeasurement corner(double range, double bearing) {
    TMeasurement m;
    m.z = {range, bearing};
    m.R = Eigen::Vector2d(4e-4, 1e-4).asDiagonal();
    return m;
}

/// A patch of `keypoints` random descriptors, 2 m ahead of the robot.
std::shared_ptr<const observations::TPatch> patch(unsigned seed, double yawError = 0) {
    std::mt19937 random(seed);
    auto result = std::make_shared<observations::TPatch>();
    result->width = result->height = 0.6;
    for (int i = 0; i < 40; ++i) {
        observations::TKeypoint k;
        k.x = 0.6 * (static_cast<double>(random() % 1000) / 1000 - 0.5);
        k.y = 0.6 * (static_cast<double>(random() % 1000) / 1000 - 0.5);
        k.scale = 0.05;
        for (auto& byte : k.descriptor) byte = static_cast<std::uint8_t>(random() % 256);
        result->keypoints.push_back(k);
    }
    result->pose.mean = CPose3D(2, 0, 1, -M_PI_2 + yawError, 0, M_PI_2);
    result->pose.cov.setDiagonal(4e-4);
    CSharedParts<observations::TPatch>::instance().numberOf(result);
    return result;
}

std::shared_ptr<const CLandmarkMapSetup> setup(int minSightingsCorner = 1) {
    TLandmarkMapSetup options;
    options.map.minSightingsCorner = minSightingsCorner;
    return std::make_shared<const CLandmarkMapSetup>(options);
}

mrpt::obs::CObservationBearingRange ranges(double range, double bearing) {
    mrpt::obs::CObservationBearingRange result;
    result.sensor_std_range = 0.02F;
    result.sensor_std_yaw = 0.01F;
    mrpt::obs::CObservationBearingRange::TMeasurement m;
    m.range = static_cast<float>(range);
    m.yaw = static_cast<float>(bearing);
    m.pitch = 0;
    m.landmarkID = mrpt::obs::INVALID_LANDMARK_ID;
    result.sensedData.push_back(m);
    result.validCovariances = false;
    return result;
}

TEST(CSalientLandmarkMap, LearnsAPlaceAsARepeatedMeasurementDoes) {
    CSalientLandmarkMap map(setup());
    const CPose2D pose(1, 2, 0.3);
    for (int k = 0; k < 4; ++k) map.learn({corner(3, 0.5)}, pose, k);
    ASSERT_EQ(map.size(), 1u);
    EXPECT_EQ(map.landmark(0).sightings, 4u);
    EXPECT_NEAR(map.place(0).mean[0], 1 + 3 * std::cos(0.8), 1e-9);
    EXPECT_NEAR(map.place(0).mean[1], 2 + 3 * std::sin(0.8), 1e-9);
    // four measurements: a quarter of the variance of one; R is 2 cm along and 3 cm across the ray
    EXPECT_NEAR(map.place(0).covariance.trace(), (4e-4 + 9e-4) / 4, 1e-8);
    EXPECT_EQ(map.lastOutcomes().measurements.at(0).decision.verdict, EVerdict::paired);
    EXPECT_EQ(map.lastOutcomes().measurements.at(0).decision.landmark, map.landmark(0).id);
}

TEST(CSalientLandmarkMap, IsConsistentOverManyDraws) {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    double sum = 0;
    constexpr int kRuns = 2000;
    for (int run = 0; run < kRuns; ++run) {
        CSalientLandmarkMap map(setup());
        const Eigen::Vector2d truth(4, 1);
        for (int k = 0; k < 5; ++k) {
            const CPose2D pose(0.5 * k, 0, 0.1 * k);
            const Eigen::Vector2d d = truth - Eigen::Vector2d(pose.x(), pose.y());
            map.learn({corner(d.norm() + 0.02 * normal(random),
                              std::atan2(d[1], d[0]) - pose.phi() + 0.01 * normal(random))},
                      pose, k);
        }
        const auto& place = map.place(0);
        const Eigen::Vector2d e = place.mean - truth;
        sum += e.dot(place.covariance.inverse() * e);
    }
    // of all runs, also those in which a measurement outside the 99.99 % made a second landmark
    EXPECT_NEAR(sum / kRuns, 2, 4 * 2 / std::sqrt(kRuns));
}

TEST(CSalientLandmarkMap, ForgetsACornerThatIsNotSeenAgain) {
    CSalientLandmarkMap map(setup(3));
    map.learn({corner(3, 0.5)}, {}, 0);
    EXPECT_EQ(map.size(), 1u);
    EXPECT_FALSE(map.isConfirmed(0));
    EXPECT_TRUE(map.lastOutcomes().measurements.at(0).provisional);
    for (int k = 0; k < 19; ++k) map.learn({corner(6, -0.5)}, {}, k);
    EXPECT_EQ(map.size(), 2u);
    map.learn({corner(6, -0.5)}, {}, 20);
    ASSERT_EQ(map.size(), 1u);
    EXPECT_TRUE(map.isConfirmed(0));
    EXPECT_NEAR(map.place(0).mean.norm(), 6, 1e-9);
}

TEST(CSalientLandmarkMap, WeighsAPoseByGeometry) {
    CSalientLandmarkMap map(setup());
    map.learn({corner(3, 0.5), corner(4, -0.7)}, {}, 0);
    const std::vector<TMeasurement> seen{corner(3, 0.5), corner(4, -0.7)};
    const double right = map.logLikelihood(seen, {}, 100);
    EXPECT_GT(right, map.logLikelihood(seen, CPose2D(0.05, 0, 0), 100));
    EXPECT_GT(right, map.logLikelihood(seen, CPose2D(0, 0, 0.03), 100));
    // far from everything a measurement counts as much as a new landmark, and no less
    const double lambda = association::TAssociationOptions().cornerLogDensity;
    EXPECT_NEAR(map.logLikelihood(seen, CPose2D(50, 0, 0), 100), 2 * lambda, 1e-9);
    // the density of one landmark, by hand
    const double P_D = association::TAssociationOptions().detectionProbability;
    const Eigen::Matrix2d S = 2 * corner(3, 0.5).R;
    const double density = P_D / (2 * M_PI * std::sqrt(S.determinant()));
    EXPECT_NEAR(map.logLikelihood({corner(3, 0.5)}, {}, 100), std::log(std::exp(lambda) + density),
                1e-6);
}

TEST(CSalientLandmarkMap, WeighsAPoseByAppearance) {
    CSalientLandmarkMap map(setup());
    map.learn({measurementOf(patch(1))}, {}, 0);
    ASSERT_EQ(map.size(), 1u);
    const double same = map.logLikelihood({measurementOf(patch(1))}, {}, 100);
    const double other = map.logLikelihood({measurementOf(patch(2))}, {}, 100);
    EXPECT_GT(same, other + 2);
    map.learn({measurementOf(patch(2))}, {}, 1);  // another poster in the same place
    EXPECT_EQ(map.landmark(0).sightings, 1u);
}

TEST(CSalientLandmarkMap, CountsTheAppearanceOfATrackOnceAlsoInACopy) {
    registerClasses();
    mrpt::maps::CMultiMetricMap one;
    one.maps.push_back(std::make_shared<CSalientLandmarkMap>(setup()));
    const auto ratioAt = [](mrpt::maps::CMultiMetricMap& maps, double time) {
        auto& map = dynamic_cast<CSalientLandmarkMap&>(*maps.maps.at(0));
        map.learn({measurementOf(patch(1))}, {}, time);
        EXPECT_EQ(map.size(), 1u);
        return map.lastOutcomes().measurements.at(0).decision.logRatio;
    };
    EXPECT_TRUE(std::isnan(ratioAt(one, 0)));  // new
    EXPECT_GT(ratioAt(one, 1), 1);             // counts
    mrpt::maps::CMultiMetricMap two = one;     // through a memory stream
    EXPECT_EQ(ratioAt(one, 2), 0);
    EXPECT_EQ(ratioAt(two, 2), 0);
    EXPECT_GT(ratioAt(two, 50), 1);  // the track has ended
    // So it does where a pose is weighed.
    const auto& map = dynamic_cast<const CSalientLandmarkMap&>(*two.maps.at(0));
    const auto seen = {measurementOf(patch(1))};
    EXPECT_GT(map.logLikelihood(seen, {}, 100), map.logLikelihood(seen, {}, 51) + 1);
}

TEST(CSalientLandmarkMap, CorrectsAPoseAsTheKalmanFilterDoes) {
    CSalientLandmarkMap map(setup());
    for (int k = 0; k < 400; ++k) map.learn({corner(4, 0)}, {}, k);  // now known to 1 mm
    CSalientLandmarkMap::TPoseBelief odometry;
    odometry.mean = {0.02, 0, 0};
    odometry.covariance = Eigen::Vector3d(4e-4, 1e-8, 1e-8).asDiagonal();
    // Range alone: variances of 4e-4 each for odometry and measurement, which says x = 0.
    const auto told = map.corrected({corner(4, 0)}, odometry, 400, 1);
    EXPECT_NEAR(told.mean[0], 0.01, 2e-4);
    EXPECT_NEAR(told.covariance(0, 0), 2e-4, 2e-6);
    // With a power of one third the measurement counts as if its variance were three times that.
    EXPECT_NEAR(map.corrected({corner(4, 0)}, odometry, 400, 1. / 3).mean[0], 0.015, 2e-4);
    // What fits no landmark tells nothing, nor does an empty map.
    EXPECT_EQ(map.corrected({corner(2, 1)}, odometry, 400, 1).mean, odometry.mean);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(map.corrected({corner(nan, 0)}, odometry, 400, 1).mean, odometry.mean);
    EXPECT_EQ(CSalientLandmarkMap(setup()).corrected({corner(4, 0)}, odometry, 0, 1).covariance,
              odometry.covariance);
}

TEST(CSalientLandmarkMap, TakesWhatMrptHandsIt) {
    CSalientLandmarkMap map(setup());
    const auto observation = ranges(3, 0.5);
    EXPECT_TRUE(map.canComputeObservationLikelihood(observation));
    EXPECT_TRUE(map.insertObservation(observation, CPose3D(1, 0, 0, 0, 0, 0)));
    EXPECT_EQ(map.size(), 1u);
    const double right = map.computeObservationLikelihood(observation, CPose3D(1, 0, 0, 0, 0, 0));
    EXPECT_GT(right, map.computeObservationLikelihood(observation, CPose3D()));
    const mrpt::obs::CObservation2DRangeScan scan;
    EXPECT_FALSE(map.canComputeObservationLikelihood(scan));
    EXPECT_FALSE(map.insertObservation(scan));
    EXPECT_EQ(map.computeObservationLikelihood(scan, CPose3D()), 0);
    map.clear();
    EXPECT_TRUE(map.isEmpty());
    map.genericMapParams.enableObservationInsertion = false;
    EXPECT_FALSE(map.insertObservation(observation));
}

TEST(CSalientLandmarkMap, CountsWhatIsNoNumberAsNothing) {
    CSalientLandmarkMap map(setup());
    const double nan = std::numeric_limits<double>::quiet_NaN();
    auto singular = corner(3, 0.5);
    singular.R.setZero();
    map.learn({corner(nan, 0), singular, corner(3, 0.5)}, {}, 0);
    EXPECT_EQ(map.size(), 1u);
    EXPECT_EQ(map.lastOutcomes().measurements.at(0).decision.verdict, EVerdict::clutter);
    EXPECT_TRUE(std::isfinite(map.logLikelihood({corner(nan, 0), singular}, {}, 100)));
    EXPECT_EQ(map.logLikelihood({}, {}, 100), 0);
    std::vector<TMeasurement> many;
    for (int i = 0; i < 3000; ++i) many.push_back(corner(2 + 0.01 * i, 0.001 * i));
    map.learn(many, {}, 1);
    EXPECT_LE(map.size(), 202u) << "max_measurements";
}

CSalientLandmarkMap filledMap() {
    CSalientLandmarkMap map(setup(2));
    for (int k = 0; k < 3; ++k)
        map.learn({corner(3, 0.5), corner(4, -0.7), measurementOf(patch(7))}, CPose2D(0.1, 0, 0),
                  k);
    map.learn({corner(7, 1)}, {}, 3);
    map.tag = 42;
    map.genericMapParams.enableObservationLikelihood = false;
    return map;
}

void expectSame(const CSalientLandmarkMap& a, const CSalientLandmarkMap& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
        EXPECT_EQ(a.place(k).mean, b.place(k).mean);
        EXPECT_EQ(a.place(k).covariance, b.place(k).covariance);
        EXPECT_EQ(a.place(k).born, b.place(k).born);
        EXPECT_EQ(a.landmark(k).id, b.landmark(k).id);
        EXPECT_EQ(a.landmark(k).sightings, b.landmark(k).sightings);
        ASSERT_EQ(a.landmark(k).views.size(), b.landmark(k).views.size());
        EXPECT_EQ(a.isConfirmed(k), b.isConfirmed(k));
    }
    EXPECT_EQ(a.tag, b.tag);
    EXPECT_EQ(a.genericMapParams.enableObservationLikelihood,
              b.genericMapParams.enableObservationLikelihood);
    EXPECT_EQ(a.asString(), b.asString());
}

TEST(CSalientLandmarkMap, SharesPatchesAndOptionsWithACopyThatMrptMakes) {
    registerClasses();
    mrpt::maps::CMultiMetricMap one;
    one.maps.push_back(std::make_shared<CSalientLandmarkMap>(filledMap()));
    const mrpt::maps::CMultiMetricMap two = one;  // through a memory stream
    const auto& a = dynamic_cast<const CSalientLandmarkMap&>(*one.maps.at(0));
    const auto& b = dynamic_cast<const CSalientLandmarkMap&>(*two.maps.at(0));
    expectSame(a, b);
    EXPECT_EQ(a.landmark(2).views.at(0).patch, b.landmark(2).views.at(0).patch);
    EXPECT_TRUE(b.lastOutcomes().measurements.empty());
    mrpt::io::CMemoryStream stream;
    mrpt::serialization::archiveFrom(stream) << a;
    EXPECT_LT(stream.getTotalBytesCount(), 1100u) << "four landmarks without their patches";
}

TEST(CSalientLandmarkMap, IsCompleteInAFile) {
    registerClasses();
    const test::CTemporaryFolder folder;
    const std::string file = (folder / "map.bin").string();
    const auto map = filledMap();
    {
        mrpt::io::CFileGZOutputStream out(file);
        mrpt::serialization::archiveFrom(out) << map;
    }
    mrpt::io::CFileGZInputStream in(file);
    CSalientLandmarkMap read;
    mrpt::serialization::archiveFrom(in) >> read;
    expectSame(map, read);
    EXPECT_NE(map.landmark(2).views.at(0).patch, read.landmark(2).views.at(0).patch);
    EXPECT_EQ(map.landmark(2).views.at(0).patch->keypoints.size(),
              read.landmark(2).views.at(0).patch->keypoints.size());
    // and learns on: the options came with it
    read.learn({corner(7, 1)}, {}, 4);
    EXPECT_TRUE(read.isConfirmed(3));
}

TEST(CSalientLandmarkMap, RefusesMemoryOfAMapThatHasGone) {
    mrpt::io::CMemoryStream stream;
    {
        CSalientLandmarkMap map(setup());
        map.learn({corner(3, 0.5)}, {}, 0);
        mrpt::serialization::archiveFrom(stream) << map;
    }
    stream.Seek(0);
    CSalientLandmarkMap read;
    EXPECT_THROW(mrpt::serialization::archiveFrom(stream) >> read, std::exception);
}

TEST(CSalientLandmarkMap, RefusesFilesThatAreCutOrBroken) {
    registerClasses();
    const test::CTemporaryFolder folder;
    const std::string file = (folder / "map.bin").string();
    {
        mrpt::io::CFileGZOutputStream out(file);
        mrpt::serialization::archiveFrom(out) << filledMap();
    }
    mrpt::io::CFileGZInputStream whole(file);
    std::string bytes(1 << 20, '\0');
    bytes.resize(whole.Read(bytes.data(), bytes.size()));
    ASSERT_GT(bytes.size(), 1000u);
    std::mt19937 random(9);
    int refused = 0;
    for (int k = 0; k < 300; ++k) {
        std::string broken = bytes;
        if (k % 2 == 0)
            broken.resize(random() % bytes.size());
        else
            for (int n = 0; n < 3; ++n) broken[random() % 1500] = static_cast<char>(random() % 256);
        const std::string name = folder.write("broken.bin", broken);
        mrpt::io::CFileGZInputStream in(name);
        CSalientLandmarkMap read;
        try {
            mrpt::serialization::archiveFrom(in) >> read;
        } catch (const std::exception&) {
            ++refused;
        }
    }
    EXPECT_GE(refused, 150);  // every cut one
}

TEST(CSalientLandmarkMap, IsMadeFromAnIniFileOfMrpt) {
    registerClasses();
    mrpt::config::CConfigFileMemory ini(
        std::string("[map]\nsalientLandmarkMap_count = 1\npointsMap_count = 1\n"
                    "[map_salientLandmarkMap_00_insertOpts]\nmin_sightings_corner = 5\n"
                    "[map_salientLandmarkMap_00_associationOpts]\nmethod = nn\n"));
    mrpt::maps::TSetOfMetricMapInitializers definitions;
    definitions.loadFromConfigFile(ini, "map");
    ASSERT_EQ(definitions.size(), 2u);
    const mrpt::maps::CMultiMetricMap maps(definitions);
    const auto map = maps.mapByClass<CSalientLandmarkMap>();
    ASSERT_TRUE(map);
    for (int k = 0; k < 4; ++k) map->learn({corner(3, 0.5)}, {}, k);
    EXPECT_FALSE(map->isConfirmed(0));
    map->learn({corner(3, 0.5)}, {}, 4);
    EXPECT_TRUE(map->isConfirmed(0));
    ini.setContent(
        std::string("[map]\nsalientLandmarkMap_count = 1\n"
                    "[map_salientLandmarkMap_00_insertOpts]\nmin_sighting = 5\n"));
    // not through the list of definitions, which loses its memory when one of them throws
    CSalientLandmarkMap::TMapDefinition definition;
    EXPECT_THROW(definition.loadFromConfigFile(ini, "map_salientLandmarkMap_00"), std::exception);
}

}  // namespace
}  // namespace salma::slam
