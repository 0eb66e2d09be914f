// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/slam/CPathSmoother.h>
#include <salma/slam/rangeBearingModel.h>

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

namespace salma::slam {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
/// A robot at rest has exact odometry; below this sigma of 0.03 mm nothing is resolved anyway.
constexpr double leastVariance = 1e-9;

/// Inverse of the lower Cholesky factor.
template <int N>
Eigen::Matrix<double, N, N> whitener(const Eigen::Matrix<double, N, N>& covariance) {
    const Eigen::LLT<Eigen::Matrix<double, N, N>> factor(covariance);
    if (factor.info() != Eigen::Success)
        throw std::runtime_error("A covariance in the path's history is not positive definite");
    return factor.matrixL().solve(Eigen::Matrix<double, N, N>::Identity());
}

/// The least squares problem; variables are all poses, then all landmarks.
class CNormalEquations {
 public:
    CNormalEquations(const CPathHistory& history, const std::vector<int>& ids);

    Eigen::Index size() const { return m_size; }
    Eigen::Index rowOf(std::size_t landmark) const {
        return 3 * static_cast<Eigen::Index>(m_history.size()) +
               2 * static_cast<Eigen::Index>(landmark);
    }
    double cost(const Eigen::VectorXd& x) const;
    /// Fills the lower triangle of J'J and -J'r.
    void build(const Eigen::VectorXd& x, Sparse& information, Eigen::VectorXd& right) const;
    Eigen::VectorXd moved(const Eigen::VectorXd& x, const Eigen::VectorXd& step) const;
    /// By landmark, mean squared residual of its measurements, per degree of freedom.
    std::vector<double> misfit(const Eigen::VectorXd& x, std::size_t landmarks) const;

 private:
    struct TMotionTerm {
        Eigen::Vector3d r;
        Eigen::Matrix3d byBefore, byAfter;
    };
    struct TSightTerm {
        Eigen::Vector2d r;
        Matrix23 byPose;
        Eigen::Matrix2d byLandmark;
    };
    TMotionTerm motion(std::size_t k, const Eigen::VectorXd& x) const;
    TSightTerm sight(std::size_t k, std::size_t i, const Eigen::VectorXd& x) const;
    Eigen::Vector3d poseBefore(std::size_t k, const Eigen::VectorXd& x) const;

    const CPathHistory& m_history;
    Eigen::Index m_size;
    std::vector<Eigen::Matrix3d> m_motionWhitener;              //!< By step.
    std::vector<std::vector<Eigen::Matrix2d>> m_sightWhitener;  //!< By step and measurement.
    std::vector<std::vector<std::size_t>> m_landmark;           //!< Index, likewise.
};

CNormalEquations::CNormalEquations(const CPathHistory& history, const std::vector<int>& ids)
    : m_history(history),
      m_size(3 * static_cast<Eigen::Index>(history.size()) +
             2 * static_cast<Eigen::Index>(ids.size())) {
    std::map<int, std::size_t> indexOf;
    for (std::size_t i = 0; i < ids.size(); ++i) indexOf[ids[i]] = i;
    std::vector<bool> seen(ids.size(), false);
    for (std::size_t k = 0; k < history.size(); ++k) {
        const Eigen::Matrix3d floor = leastVariance * Eigen::Matrix3d::Identity();
        m_motionWhitener.push_back(whitener<3>(history[k].Q + floor));
        auto& whiteners = m_sightWhitener.emplace_back();
        auto& landmarks = m_landmark.emplace_back();
        for (const TUsedMeasurement& used : history[k].used) {
            const auto found = indexOf.find(used.landmark);
            if (found == indexOf.end())
                throw std::invalid_argument("The path has measurements of landmark " +
                                            std::to_string(used.landmark) +
                                            ", which the map has not");
            seen[found->second] = true;
            landmarks.push_back(found->second);
            whiteners.push_back(whitener<2>(used.R));
        }
    }
    for (std::size_t i = 0; i < ids.size(); ++i)
        if (!seen[i])
            throw std::invalid_argument("Landmark " + std::to_string(ids[i]) +
                                        " was never measured");
}

Eigen::Vector3d CNormalEquations::poseBefore(std::size_t k, const Eigen::VectorXd& x) const {
    if (k == 0) return Eigen::Vector3d::Zero();
    return x.segment<3>(3 * static_cast<Eigen::Index>(k - 1));
}

CNormalEquations::TMotionTerm CNormalEquations::motion(std::size_t k,
                                                       const Eigen::VectorXd& x) const {
    const Eigen::Vector3d before = poseBefore(k, x);
    const Eigen::Vector3d after = x.segment<3>(3 * static_cast<Eigen::Index>(k));
    const double c = std::cos(before[2]), s = std::sin(before[2]);
    const double dx = after[0] - before[0], dy = after[1] - before[1];
    const Eigen::Vector3d& u = m_history[k].increment;
    TMotionTerm term;
    term.r << c * dx + s * dy - u[0], -s * dx + c * dy - u[1],
        mrpt::math::wrapToPi(after[2] - before[2] - u[2]);
    term.byAfter << c, s, 0, -s, c, 0, 0, 0, 1;
    term.byBefore << -c, -s, -s * dx + c * dy, s, -c, -c * dx - s * dy, 0, 0, -1;
    const Eigen::Matrix3d& W = m_motionWhitener[k];
    return {W * term.r, W * term.byBefore, W * term.byAfter};
}

CNormalEquations::TSightTerm CNormalEquations::sight(std::size_t k,
                                                     std::size_t i,
                                                     const Eigen::VectorXd& x) const {
    const TSighting expected = sighting(x.segment<3>(3 * static_cast<Eigen::Index>(k)),
                                        x.segment<2>(rowOf(m_landmark[k][i])));
    const Eigen::Vector2d& z = m_history[k].used[i].z;
    const Eigen::Vector2d r(expected.z[0] - z[0], mrpt::math::wrapToPi(expected.z[1] - z[1]));
    const Eigen::Matrix2d& W = m_sightWhitener[k][i];
    return {W * r, W * expected.byPose, W * expected.byLandmark};
}

double CNormalEquations::cost(const Eigen::VectorXd& x) const {
    double sum = 0;
    for (std::size_t k = 0; k < m_history.size(); ++k) {
        sum += motion(k, x).r.squaredNorm();
        for (std::size_t i = 0; i < m_landmark[k].size(); ++i)
            sum += sight(k, i, x).r.squaredNorm();
    }
    return sum;
}

void CNormalEquations::build(const Eigen::VectorXd& x,
                             Sparse& information,
                             Eigen::VectorXd& right) const {
    std::vector<Eigen::Triplet<double>> entries;
    right = Eigen::VectorXd::Zero(m_size);
    const auto add = [&](Eigen::Index row, Eigen::Index column, const auto& block) {
        for (Eigen::Index a = 0; a < block.rows(); ++a)
            for (Eigen::Index b = 0; b < block.cols(); ++b)
                if (row + a >= column + b) entries.emplace_back(row + a, column + b, block(a, b));
    };
    for (std::size_t k = 0; k < m_history.size(); ++k) {
        const Eigen::Index after = 3 * static_cast<Eigen::Index>(k), before = after - 3;
        const TMotionTerm m = motion(k, x);
        add(after, after, (m.byAfter.transpose() * m.byAfter).eval());
        right.segment<3>(after) -= m.byAfter.transpose() * m.r;
        if (k > 0) {
            add(before, before, (m.byBefore.transpose() * m.byBefore).eval());
            add(after, before, (m.byAfter.transpose() * m.byBefore).eval());
            right.segment<3>(before) -= m.byBefore.transpose() * m.r;
        }
        for (std::size_t i = 0; i < m_landmark[k].size(); ++i) {
            const Eigen::Index row = rowOf(m_landmark[k][i]);
            const TSightTerm t = sight(k, i, x);
            add(after, after, (t.byPose.transpose() * t.byPose).eval());
            add(row, row, (t.byLandmark.transpose() * t.byLandmark).eval());
            add(row, after, (t.byLandmark.transpose() * t.byPose).eval());
            right.segment<3>(after) -= t.byPose.transpose() * t.r;
            right.segment<2>(row) -= t.byLandmark.transpose() * t.r;
        }
    }
    information.resize(m_size, m_size);
    information.setFromTriplets(entries.begin(), entries.end());
}

Eigen::VectorXd CNormalEquations::moved(const Eigen::VectorXd& x,
                                        const Eigen::VectorXd& step) const {
    Eigen::VectorXd result = x + step;
    for (std::size_t k = 0; k < m_history.size(); ++k) {
        double& heading = result[3 * static_cast<Eigen::Index>(k) + 2];
        heading = mrpt::math::wrapToPi(heading);
    }
    return result;
}

std::vector<double> CNormalEquations::misfit(const Eigen::VectorXd& x,
                                             std::size_t landmarks) const {
    std::vector<double> sum(landmarks, 0), count(landmarks, 0);
    for (std::size_t k = 0; k < m_history.size(); ++k)
        for (std::size_t i = 0; i < m_landmark[k].size(); ++i) {
            sum[m_landmark[k][i]] += sight(k, i, x).r.squaredNorm();
            count[m_landmark[k][i]] += 2;
        }
    for (std::size_t i = 0; i < landmarks; ++i) sum[i] /= count[i];
    return sum;
}

/// Covariance of the last pose and the landmarks: their columns of the inverse.
RowMatrix covarianceOf(const Eigen::SimplicialLDLT<Sparse>& factor, Eigen::Index lastPose) {
    const Eigen::Index size = factor.rows() - lastPose;
    RowMatrix result(size, size);
    Eigen::VectorXd unit = Eigen::VectorXd::Zero(factor.rows());
    for (Eigen::Index k = 0; k < size; ++k) {
        unit[lastPose + k] = 1;
        result.row(k) = factor.solve(unit).tail(size).transpose();
        unit[lastPose + k] = 0;
    }
    return 0.5 * (result + result.transpose().eval());
}

}  // namespace

CPathSmoother::CPathSmoother(int maxIterations) : m_maxIterations(maxIterations) {}

TSmoothed CPathSmoother::smooth(const CPathHistory& history,
                                const std::vector<int>& ids,
                                const std::vector<Eigen::Vector2d>& start,
                                bool withCovariance) const {
    if (history.empty()) throw std::invalid_argument("A path without steps cannot be estimated");
    const CNormalEquations equations(history, ids);
    Eigen::VectorXd x(equations.size());
    for (std::size_t k = 0; k < history.size(); ++k)
        x.segment<3>(3 * static_cast<Eigen::Index>(k)) = history[k].pose;
    for (std::size_t i = 0; i < ids.size(); ++i) x.segment<2>(equations.rowOf(i)) = start[i];

    TSmoothed result;
    result.cost = equations.cost(x);
    Eigen::SimplicialLDLT<Sparse> factor;
    Sparse information;
    Eigen::VectorXd right;
    double damping = 1e-6;
    while (!result.converged && result.iterations < m_maxIterations) {
        equations.build(x, information, right);
        bool better = false;
        while (!better && damping < 1e12) {
            ++result.iterations;
            Sparse damped = information;
            damped.diagonal() *= 1 + damping;
            factor.compute(damped);
            if (factor.info() == Eigen::Success) {
                const Eigen::VectorXd candidate = equations.moved(x, factor.solve(right));
                const double cost = equations.cost(candidate);
                if (cost <= result.cost) {  // false for NaN
                    result.converged = result.cost - cost <= 1e-6 + 1e-7 * cost;
                    x = candidate;
                    result.cost = cost;
                    better = true;
                }
            }
            damping = better ? std::max(damping / 10, 1e-9) : damping * 10;
        }
        if (!better) result.converged = true;  // no step leads down: this is the bottom
    }
    equations.build(x, information, right);
    factor.compute(information);
    if (factor.info() != Eigen::Success || !x.allFinite())
        throw std::runtime_error("The path of " + std::to_string(history.size()) +
                                 " steps cannot be estimated: its equations are singular");
    const Eigen::Index lastPose = 3 * static_cast<Eigen::Index>(history.size() - 1);
    for (std::size_t k = 0; k < history.size(); ++k)
        result.poses.push_back(x.segment<3>(3 * static_cast<Eigen::Index>(k)));
    result.mean = x.tail(x.size() - lastPose);
    result.misfit = equations.misfit(x, ids.size());
    if (withCovariance) result.covariance = covarianceOf(factor, lastPose);
    if (!result.covariance.allFinite())
        throw std::runtime_error("The covariance of the path is not finite");
    return result;
}

}  // namespace salma::slam
