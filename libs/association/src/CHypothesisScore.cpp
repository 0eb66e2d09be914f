// SPDX-License-Identifier: BSD-3-Clause
#include "CHypothesisScore.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace salma::association {
namespace {

constexpr double leastDetection = 1e-3;  // no landmark is surely missed or surely seen

/// A diagonal matrix that is not larger than R, as its two entries.
Eigen::Vector2d diagonalBelow(const Eigen::Matrix2d& R) {
    const double correlation = std::abs(R(1, 0)) / std::sqrt(R(0, 0) * R(1, 1));
    return (1 - correlation) * R.diagonal();
}

/// What a landmark's prediction keeps of its covariance when all others are measured as well as
/// `noise` allows (two entries per landmark); zero where the matrices are not sound.
std::vector<Eigen::Matrix2d> remainders(const Eigen::MatrixXd& prediction,
                                        const Eigen::VectorXd& noise) {
    std::vector<Eigen::Matrix2d> result(static_cast<std::size_t>(noise.size() / 2),
                                        Eigen::Matrix2d::Zero());
    const Eigen::MatrixXd whole = prediction + Eigen::MatrixXd(noise.asDiagonal());
    const Eigen::LLT<Eigen::MatrixXd> factor(whole);
    if (factor.info() != Eigen::Success) return result;
    const Eigen::MatrixXd information =
        factor.solve(Eigen::MatrixXd::Identity(whole.rows(), whole.cols()));
    for (std::size_t k = 0; k < result.size(); ++k) {
        const auto row = static_cast<Eigen::Index>(2 * k);
        Eigen::Matrix2d left = information.block<2, 2>(row, row).inverse();
        left -= Eigen::Matrix2d(noise.segment<2>(row).asDiagonal());
        if (left.allFinite() && left(0, 0) > 0 && left.determinant() > 0) result[k] = left;
    }
    return result;
}

double logPeak(const Eigen::Matrix2d& covariance) {
    return -0.5 * std::log(4 * M_PI * M_PI * covariance.determinant());
}

}  // namespace

CHypothesisScore::CHypothesisScore(const TAssociationOptions& options,
                                   const TAssociationProblem& problem,
                                   const CGatedStep& step,
                                   const std::vector<TBranch>& branches)
    : m_options(options), m_problem(problem), m_terms(branches.size()) {
    for (std::size_t k = 0; k < branches.size(); ++k)
        for (const TPair& pair : step.pairs(branches[k].observation))
            if (pair.landmark == branches[k].landmark) m_terms[k].gain = gainOf(branches[k], pair);
    setBounds(branches, step.identityPairings());
}

double CHypothesisScore::gainOf(const TBranch& branch, const TPair& pair) const {
    const double visible = m_problem.visibility ? m_problem.visibility(branch.landmark) : 1;
    if (!(visible >= 0 && visible <= 1))
        throw std::invalid_argument("Visibility of landmark " + std::to_string(branch.landmark) +
                                    " is " + std::to_string(visible) + ", not from 0 to 1");
    const double detection =
        std::clamp(visible * m_options.detectionProbability, leastDetection, 1 - leastDetection);
    return std::log(detection / (1 - detection)) + (std::isnan(pair.logRatio) ? 0 : pair.logRatio);
}

void CHypothesisScore::setBounds(const std::vector<TBranch>& branches,
                                 const std::vector<TBranch>& given) {
    std::map<std::size_t, Eigen::Vector2d> noiseOf;  // by landmark: the smallest
    for (const auto* list : {&branches, &given})
        for (const TBranch& branch : *list) {
            const Eigen::Vector2d noise =
                diagonalBelow(m_problem.measurements[branch.observation].R);
            const auto [entry, isFirst] = noiseOf.insert({branch.landmark, noise});
            if (!isFirst) entry->second = entry->second.cwiseMin(noise);
        }
    const auto size = static_cast<Eigen::Index>(2 * noiseOf.size());
    Eigen::MatrixXd prediction(size, size);
    Eigen::VectorXd noises(size);
    Eigen::Index row = 0;
    for (const auto& [landmark, noise] : noiseOf) {
        noises.segment<2>(row) = noise;
        Eigen::Index column = 0;
        for (const auto& other : noiseOf) {
            prediction.block<2, 2>(row, column) =
                m_problem.predictionCovariance.block<2, 2>(2 * landmark, 2 * other.first);
            column += 2;
        }
        row += 2;
    }
    const std::vector<Eigen::Matrix2d> left = remainders(prediction, noises);
    for (std::size_t k = 0; k < branches.size(); ++k) {
        const auto entry = noiseOf.find(branches[k].landmark);
        const Eigen::Matrix2d& C = left[std::distance(noiseOf.begin(), entry)];
        const Eigen::Matrix2d& R = m_problem.measurements[branches[k].observation].R;
        m_terms[k].floor = R + C;
        m_terms[k].bound = m_terms[k].gain + logPeak(m_terms[k].floor);
        const Eigen::Matrix2d told = C + Eigen::Matrix2d(entry->second.asDiagonal());
        m_terms[k].lowest = R + C - C * told.inverse() * C;
    }
}

double CHypothesisScore::unexplained(std::size_t observation) const {
    return m_problem.measurements[observation].kind == ELandmarkKind::corner
               ? m_options.cornerLogDensity
               : m_options.salientLogDensity;
}

double CHypothesisScore::clutter(std::size_t observation) const {
    return m_problem.measurements[observation].kind == ELandmarkKind::corner
               ? m_options.cornerClutterLogDensity
               : m_options.salientClutterLogDensity;
}

}  // namespace salma::association
