// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/slam/COdometryNoise.h>
#include <salma/slam/CSlamBackend.h>
#include <salma/slam/rangeBearingModel.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>
#include <vector>

namespace salma::slam::test {

/** Point landmarks around a square path of 8 m sides, and a robot that drives it with noise of
 * exactly the covariances that its steps state. */
class CTestWorld {
 public:
    explicit CTestWorld(std::uint32_t seed) : m_random(seed) {
        std::uniform_real_distribution<double> place(-4, 12);
        while (m_landmarks.size() < 30) {
            const Eigen::Vector2d candidate(place(m_random), place(m_random));
            bool apart = true;
            for (const auto& other : m_landmarks) apart = apart && (candidate - other).norm() > 1.5;
            if (apart) m_landmarks.push_back(candidate);
        }
    }

    /// Drives 0.4 m, with a quarter turn at each corner, and looks around.
    TStepInput next() {
        const bool corner = ++m_count % 20 == 0;
        const Eigen::Vector3d increment(0.4, 0, corner ? M_PI / 2 : 0);
        m_pose = moved(m_pose, increment).pose;
        TStepInput step;
        step.time = m_count;
        step.increment = m_noise.increment({increment[0], increment[1], increment[2]});
        const Eigen::Vector3d error = sample<3>(step.increment.cov.asEigen());
        step.increment.mean = {increment[0] + error[0], error[1], increment[2] + error[2]};
        for (std::size_t i = 0; i < m_landmarks.size(); ++i) {
            const Eigen::Vector2d z = sighting(m_pose, m_landmarks[i]).z;
            if (z[0] > 6 || std::abs(z[1]) > M_PI / 2) continue;
            association::TMeasurement measurement;
            measurement.R = Eigen::Vector2d(0.05 * 0.05, 0.01 * 0.01).asDiagonal();
            measurement.z = z + sample<2>(measurement.R);
            measurement.identity = static_cast<int>(i);
            step.measurements.push_back(measurement);
        }
        return step;
    }

    const Eigen::Vector3d& pose() const { return m_pose; }
    const std::vector<Eigen::Vector2d>& landmarks() const { return m_landmarks; }

 private:
    template <int SIZE>
    Eigen::Matrix<double, SIZE, 1> sample(const Eigen::Matrix<double, SIZE, SIZE>& covariance) {
        Eigen::Matrix<double, SIZE, 1> unit;
        for (double& value : unit) value = m_normal(m_random);
        return covariance.llt().matrixL() * unit;
    }

    std::mt19937 m_random;
    std::normal_distribution<double> m_normal{0, 1};
    COdometryNoise m_noise;
    std::vector<Eigen::Vector2d> m_landmarks;
    Eigen::Vector3d m_pose{0, 0, 0};
    int m_count{0};
};

}  // namespace salma::slam::test
