// SPDX-License-Identifier: BSD-3-Clause
// Two laps in a hallway of equal doors, with posters that tell the places apart.
#include <gtest/gtest.h>
#include <salma/slam/COdometryNoise.h>
#include <salma/slam/CSalientEKF2D.h>
#include <salma/slam/rangeBearingModel.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <map>
#include <random>

namespace salma::slam {
namespace {

/// A feature on the inner or outer wall of one side of the hallway.
struct TFeature {
    Eigen::Vector2d position;
    int side;
    bool poster;
    double wallAngle;  //!< World [rad].
    bool convex;
};

/** A rectangular hallway of 20 m by 10 m, 2 m wide: a door of 0.9 m every 2.5 m on both walls, with
 * two corners each, and posters at irregular places. */
class CHallway {
 public:
    CHallway(std::uint32_t seed, int posters) : m_random(seed) {
        std::uniform_real_distribution<double> anywhere(1.5, 18.5);
        for (int side = 0; side < 4; ++side) {
            const double length = side % 2 == 0 ? 20 : 10;
            for (double along = 1.5; along < length - 1.5; along += 2.5)
                for (double across : {-1.0, 1.0})
                    for (double jamb : {0.0, 0.9}) add(side, along + jamb, across, false);
        }
        for (int i = 0; i < posters; ++i) {
            const int side = i % 4;
            const double along = anywhere(m_random) * (side % 2 == 0 ? 1 : 0.5);
            add(side, along, i % 3 == 0 ? 1 : -1, true);
        }
    }

    TStepInput next() {
        const double forward = 0.1;
        m_along += forward;
        double turn = 0;
        if (m_along >= (m_side % 2 == 0 ? 20 : 10)) {
            m_along = 0;
            m_side = (m_side + 1) % 4;
            turn = M_PI / 2;
        }
        m_pose = moved(m_pose, {forward, 0, turn}).pose;
        TStepInput step;
        step.time = 0.2 * ++m_count;
        step.increment = m_noise.increment({forward, 0, turn});
        const Eigen::Vector3d error = sample<3>(step.increment.cov.asEigen());
        step.increment.mean = {forward + error[0], error[1], turn + error[2]};
        step.odometry = m_odometry = m_odometry + step.increment.mean;
        for (std::size_t i = 0; i < m_features.size(); ++i) look(i, step);
        return step;
    }

    const Eigen::Vector3d& pose() const { return m_pose; }
    /// True feature of each measurement so far.
    const std::vector<std::size_t>& truth() const { return m_truth; }

    /// Appearance that tells two posters apart nine times out of ten; their mark is the width.
    double ratio(const observations::TPatch& a, const observations::TPatch& b) {
        if (m_uniform(m_appearance) < 0.1) return -0.5;  // neither proves nor excludes
        return a.width == b.width ? 3.5 : -3;
    }

 private:
    void add(int side, double along, double across, bool poster) {
        const Eigen::Vector2d start[] = {{0, 0}, {20, 0}, {20, 10}, {0, 10}};
        const double direction = side * M_PI / 2;
        const Eigen::Vector2d ahead(std::cos(direction), std::sin(direction));
        const Eigen::Vector2d left(-ahead[1], ahead[0]);
        m_features.push_back({start[side] + along * ahead + across * left, side, poster,
                              direction + (across > 0 ? -M_PI / 2 : M_PI / 2),
                              !poster && across > 0});
    }

    void look(std::size_t i, TStepInput& step) {
        const TFeature& feature = m_features[i];
        const Eigen::Vector2d z = sighting(m_pose, feature.position).z;
        const bool cameraStep = m_count % 5 == 0;
        const double reach = feature.side != m_side ? 3.5 : feature.poster ? 4 : 8;
        if (z[0] > reach || std::abs(z[1]) > (feature.poster ? 0.9 : M_PI / 2) ||
            feature.poster != cameraStep)
            return;
        if (m_uniform(m_random) > 0.8) return;
        association::TMeasurement measurement;
        measurement.R = Eigen::Vector2d(0.03 * 0.03, 0.01 * 0.01).asDiagonal();
        measurement.z = z + sample<2>(measurement.R);
        measurement.convex = feature.convex;
        if (feature.poster) {
            measurement.kind = association::ELandmarkKind::salient;
            auto patch = std::make_shared<observations::TPatch>();
            patch->width = static_cast<double>(i);
            measurement.patch = patch;
            measurement.wallAngle = feature.wallAngle - m_pose[2];
            measurement.wallAngleSigma = 0.02;
        }
        step.measurements.push_back(measurement);
        m_truth.push_back(i);
    }

    template <int SIZE>
    Eigen::Matrix<double, SIZE, 1> sample(const Eigen::Matrix<double, SIZE, SIZE>& covariance) {
        Eigen::Matrix<double, SIZE, 1> unit;
        for (double& value : unit) value = m_normal(m_random);
        return covariance.llt().matrixL() * unit;
    }

    std::mt19937 m_random;
    std::mt19937 m_appearance{1};
    std::normal_distribution<double> m_normal{0, 1};
    std::uniform_real_distribution<double> m_uniform{0, 1};
    COdometryNoise m_noise;
    std::vector<TFeature> m_features;
    std::vector<std::size_t> m_truth;
    Eigen::Vector3d m_pose{0, 0, 0};
    mrpt::poses::CPose2D m_odometry;
    int m_side{0};
    double m_along{0};
    int m_count{0};
};

struct TOutcome {
    double end{0};          //!< Distance of the estimated from the true place after two laps [m].
    double odometryEnd{0};  //!< The same for odometry alone [m].
    std::size_t landmarks{0};
    std::size_t paired{0};
    std::size_t wrong{0};  //!< Pairings with a landmark of another feature.
};

void count(const TRunRecord& record, const std::vector<std::size_t>& truth, TOutcome& outcome) {
    std::map<int, std::size_t> featureOf;
    for (std::size_t i = 0; i < record.associations.size(); ++i) {
        const TAssociationRow& row = record.associations[i];
        if (row.decision == EDecision::created) featureOf[row.landmark] = truth[i];
        if (row.decision != EDecision::paired) continue;
        ++outcome.paired;
        outcome.wrong += featureOf[row.landmark] != truth[i];
    }
    outcome.landmarks = record.landmarks.size();
}

TOutcome drive(std::uint32_t seed, association::EMethod method) {
    CHallway hallway(seed, 12);
    association::TAssociationOptions options;
    options.method = method;
    CSalientEKF2D filter({}, options,
                         [&](const auto& a, const auto& b) { return hallway.ratio(a, b); });
    for (int i = 0; i < 1200; ++i) filter.process(hallway.next());
    TRunRecord record;
    filter.results(record);
    const auto apart = [&](const mrpt::poses::CPose2D& pose) {
        return std::hypot(pose.x() - hallway.pose()[0], pose.y() - hallway.pose()[1]);
    };
    TOutcome outcome;
    outcome.end = apart(record.trajectory.back().pose);
    outcome.odometryEnd = apart(record.trajectory.back().odometry);
    count(record, hallway.truth(), outcome);
    return outcome;
}

TEST(Hallway, IsMappedOnceByPostersAndCornersTogether) {
    // corner_log_density was chosen on seeds 1 to 5.
    for (std::uint32_t seed = 6; seed <= 10; ++seed) {
        const TOutcome outcome = drive(seed, association::EMethod::saliency);
        std::cout << "seed " << seed << ": ends at " << outcome.end << " m, odometry at "
                  << outcome.odometryEnd << " m, " << outcome.paired << " pairings" << std::endl;
        EXPECT_EQ(outcome.wrong, 0u) << "seed " << seed;
        EXPECT_EQ(outcome.landmarks, 92u) << "seed " << seed;  // 80 corners and 12 posters
        EXPECT_LT(outcome.end, 0.15) << "seed " << seed;
        EXPECT_GT(outcome.odometryEnd, 1) << "seed " << seed;
    }
}

// The door that comes next looks like the one that was: otherwise the test above proves nothing.
TEST(Hallway, MisleadsTheNearestNeighbour) {
    const TOutcome outcome = drive(1, association::EMethod::nn);
    EXPECT_GT(outcome.wrong, 0u);
    EXPECT_GT(outcome.landmarks, 92u);
}

}  // namespace
}  // namespace salma::slam
