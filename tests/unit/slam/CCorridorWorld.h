// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/slam/COdometryNoise.h>
#include <salma/slam/CSalientEKF2D.h>
#include <salma/slam/rangeBearingModel.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <map>
#include <random>
#include <vector>

namespace salma::slam::test {

/// What is built, and how badly the wheels count.
struct TCorridorOptions {
    std::uint32_t seed{1};
    int rings{1};            //!< Congruent rings, 45 m apart, with a path from one to the next.
    int laps{2};             //!< In each ring.
    int visits{1};           //!< All rings are driven so often.
    int posters{14};         //!< In each ring.
    int prints{0};           //!< Of these, so many show one of three pictures that hang everywhere.
    double driftFactor{1};   //!< True odometry noise over the stated one.
    double statedFactor{1};  //!< Stated noise over that of good wheels.
    double headingBias{0};   //!< Systematic drift [rad/m].
    int slipAt{0};           //!< Step in which the wheels slip; 0: never.
    double slip{0};          //!< What odometry reads too much then [m].
};

/** Rectangular rings of corridor, 20 m by 10 m and 2 m wide: a door of 0.9 m every 2.5 m on all
 * walls, with two corners each, and posters at irregular places. A laser sees corners within 6 m, a
 * camera straight ahead posters within 4 m; walls hide both. */
class CCorridorWorld {
 public:
    explicit CCorridorWorld(const TCorridorOptions& options)
        : m_options(options), m_random(options.seed) {
        for (int ring = 0; ring < options.rings; ++ring) addRing(ring);
        for (int visit = 0; visit < options.visits; ++visit)
            for (int ring = 0; ring < options.rings; ++ring) addPath(ring);
        m_noise = COdometryNoise(stated(options.statedFactor));
    }

    bool done() const { return m_next >= m_path.size(); }

    /// Drives on by 0.1 m or turns by up to 15 deg, and looks around.
    TStepInput next() {
        const Eigen::Vector3d motion = drive();
        m_pose = moved(m_pose, motion).pose;
        TStepInput step;
        step.time = 0.2 * ++m_count;
        step.increment = m_noise.increment({motion[0], motion[1], motion[2]});
        const Eigen::Vector3d error =
            m_options.driftFactor * sample<3>(step.increment.cov.asEigen());
        step.increment.mean = {motion[0] + error[0], error[1],
                               motion[2] + error[2] + m_options.headingBias * motion[0]};
        if (m_count == m_options.slipAt) step.increment.mean.x_incr(m_options.slip);
        step.odometry = m_odometry = m_odometry + step.increment.mean;
        step.laser = scan();
        if (m_count % 3 == 0) {
            step.camera = TCameraView{{0, 0, 0}, 0.9};
            for (std::size_t i = 0; i < m_features.size(); ++i)
                if (m_features[i].poster) look(i, step);
        } else {
            step.scanned = true;
            for (std::size_t i = 0; i < m_features.size(); ++i)
                if (!m_features[i].poster) look(i, step);
        }
        return step;
    }

    const Eigen::Vector3d& pose() const { return m_pose; }
    const mrpt::poses::CPose2D& odometry() const { return m_odometry; }
    /// True feature of each measurement so far.
    const std::vector<std::size_t>& truth() const { return m_truth; }
    std::size_t features() const { return m_features.size(); }
    bool isPoster(std::size_t feature) const { return m_features[feature].poster; }
    /// Takes a feature off its wall.
    void takeDown(std::size_t feature) { m_features[feature].there = false; }

    /// Appearance: pictures are told apart by their mark, the width; views of one pass agree.
    static double ratio(const observations::TPatch& a, const observations::TPatch& b) {
        return a.width == b.width ? 3 : -2.5;
    }

 private:
    struct TFeature {
        Eigen::Vector2d position;
        bool poster;
        double wallAngle;  //!< World [rad].
        bool convex;
        double mark;
        bool there;
    };
    struct TWall {
        Eigen::Vector2d from, to;
    };

    static TOdometryOptions stated(double factor) {
        TOdometryOptions options;
        options.alongPerMetre = 0.05;
        options.headingPerMetre = 1.2 * M_PI / 180;
        options.headingPerRadian = 1.7 * M_PI / 180;
        for (double* sigma : {&options.alongPerMetre, &options.acrossPerMetre,
                              &options.headingPerMetre, &options.headingPerRadian})
            *sigma *= factor;
        return options;
    }

    void addRing(int ring) {
        const Eigen::Vector2d at(45.0 * ring, 0);
        std::uniform_real_distribution<double> anywhere(0.08, 0.92);
        const Eigen::Vector2d start[] = {{0, 0}, {20, 0}, {20, 10}, {0, 10}};
        for (int side = 0; side < 4; ++side) {
            const double length = side % 2 == 0 ? 20 : 10;
            for (double along = 1.5; along < length - 1.5; along += 2.5)
                for (double across : {-1.0, 1.0})
                    for (double jamb : {0.0, 0.9})
                        add(at + start[side], side, along + jamb, across);
        }
        const std::size_t first = m_features.size();
        for (int i = 0; i < m_options.posters; ++i) {
            const int side = i % 4;
            add(at + start[side], side, anywhere(m_random) * (side % 2 == 0 ? 20 : 10),
                i % 3 == 0 ? 1 : -1);
            m_features.back().poster = true;
            m_features.back().convex = false;
            // Pictures that hang everywhere hang alike in all rings.
            m_features.back().mark =
                i < m_options.prints ? 1e6 + i % 3 : static_cast<double>(first + i);
        }
        for (const auto& [low, high] :
             {std::pair<Eigen::Vector2d, Eigen::Vector2d>{{-1, -1}, {21, 11}}, {{1, 1}, {19, 9}}}) {
            const Eigen::Vector2d a = at + low, c = at + high, b(c.x(), a.y()), d(a.x(), c.y());
            for (const TWall& wall : {TWall{a, b}, TWall{b, c}, TWall{c, d}, TWall{d, a}})
                m_walls.push_back(wall);
        }
    }

    void add(const Eigen::Vector2d& start, int side, double along, double across) {
        const double direction = side * M_PI / 2;
        const Eigen::Vector2d ahead(std::cos(direction), std::sin(direction));
        const Eigen::Vector2d left(-ahead[1], ahead[0]);
        // Slightly in front of the wall, which would hide it by rounding.
        m_features.push_back({start + along * ahead + 0.98 * across * left, false,
                              direction + (across > 0 ? -M_PI / 2 : M_PI / 2), across > 0, 0,
                              true});
    }

    void addPath(int ring) {
        const Eigen::Vector2d at(45.0 * ring, 0);
        for (int lap = 0; lap < m_options.laps; ++lap)
            for (const Eigen::Vector2d& corner : {Eigen::Vector2d(20, 0), Eigen::Vector2d(20, 10),
                                                  Eigen::Vector2d(0, 10), Eigen::Vector2d(0, 0)})
                m_path.push_back(at + corner);
        m_path.push_back(at + Eigen::Vector2d(3, 0));
        if (m_options.rings > 1) {
            m_path.push_back(at + Eigen::Vector2d(3, -6));
            m_path.push_back({45.0 * ((ring + 1) % m_options.rings), -6});
            m_path.push_back({45.0 * ((ring + 1) % m_options.rings), 0});
        }
    }

    Eigen::Vector3d drive() {
        const Eigen::Vector2d way = m_path[m_next] - m_pose.head<2>();
        if (way.norm() < 0.06) {
            ++m_next;
            return {0, 0, 0};
        }
        const double turn = mrpt::math::wrapToPi(std::atan2(way.y(), way.x()) - m_pose[2]);
        const double largest = 15 * M_PI / 180;
        if (std::abs(turn) > 1e-6) return {0, 0, std::clamp(turn, -largest, largest)};
        return {std::min(0.1, way.norm()), 0, 0};
    }

    /// Distance to the nearest wall in a direction; 30 without one.
    double freeAlong(double angle) const {
        const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
        double nearest = 30;
        for (const TWall& wall : m_walls) {
            if ((wall.from - m_pose.head<2>()).norm() > 60) continue;
            Eigen::Matrix2d A;
            A << ray, wall.from - wall.to;
            if (std::abs(A.determinant()) < 1e-9) continue;
            const Eigen::Vector2d s = A.inverse() * (wall.from - m_pose.head<2>());
            // The way out to the next ring is a gap in the outer wall.
            if (s[0] > 0 && s[1] >= 0 && s[1] <= 1) nearest = std::min(nearest, s[0]);
        }
        return nearest;
    }

    TLaserView scan() const {
        TLaserView view;
        view.first = -M_PI / 2;
        view.spacing = M_PI / 180;
        auto free = std::make_shared<std::vector<float>>();
        for (int i = 0; i <= 180; ++i)
            free->push_back(static_cast<float>(freeAlong(m_pose[2] - M_PI / 2 + i * view.spacing)));
        view.free = free;
        return view;
    }

    void look(std::size_t i, TStepInput& step) {
        const TFeature& feature = m_features[i];
        const Eigen::Vector2d z = sighting(m_pose, feature.position).z;
        if (!feature.there || z[0] > (feature.poster ? 4 : 6) ||
            std::abs(z[1]) > (feature.poster ? 0.85 : M_PI / 2) ||
            freeAlong(m_pose[2] + z[1]) < z[0] || m_uniform(m_random) > 0.8)
            return;
        association::TMeasurement measurement;
        measurement.R = Eigen::Vector2d(0.03 * 0.03, 0.01 * 0.01).asDiagonal();
        measurement.z = z + sample<2>(measurement.R);
        measurement.convex = feature.convex;
        if (feature.poster) {
            measurement.kind = association::ELandmarkKind::salient;
            auto patch = std::make_shared<observations::TPatch>();
            patch->width = feature.mark;
            measurement.patch = patch;
            measurement.wallAngleSigma = 0.02;
            measurement.wallAngle =
                mrpt::math::wrapToPi(feature.wallAngle - m_pose[2] + 0.02 * m_normal(m_random));
        }
        step.measurements.push_back(measurement);
        m_truth.push_back(i);
    }

    template <int SIZE>
    Eigen::Matrix<double, SIZE, 1> sample(const Eigen::Matrix<double, SIZE, SIZE>& covariance) {
        Eigen::Matrix<double, SIZE, 1> unit;
        for (double& value : unit) value = m_normal(m_random);
        const Eigen::Matrix<double, SIZE, SIZE> sound =
            covariance + 1e-14 * Eigen::Matrix<double, SIZE, SIZE>::Identity();
        return sound.llt().matrixL() * unit;
    }

    TCorridorOptions m_options;
    std::mt19937 m_random;
    std::normal_distribution<double> m_normal{0, 1};
    std::uniform_real_distribution<double> m_uniform{0, 1};
    COdometryNoise m_noise;
    std::vector<TFeature> m_features;
    std::vector<TWall> m_walls;
    std::vector<Eigen::Vector2d> m_path;
    std::vector<std::size_t> m_truth;
    Eigen::Vector3d m_pose{0, 0, 0};
    mrpt::poses::CPose2D m_odometry;
    std::size_t m_next{0};
    int m_count{0};
};

}  // namespace salma::slam::test
