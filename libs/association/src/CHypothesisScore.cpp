// SPDX-License-Identifier: BSD-3-Clause
#include "CHypothesisScore.h"

#include <salma/association/CJointInnovation.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

#include "informationBlocks.h"

namespace salma::association {
namespace {

constexpr double leastDetection = 0.01;  // no landmark is surely missed or surely seen

/// Smallest eigenvalue of a correlation matrix, or a little less.
double leastEigenvalue(const Eigen::Matrix2d& m) { return 1 - std::abs(m(1, 0)); }

double leastEigenvalue(const Eigen::Matrix3d& m) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(m, Eigen::EigenvaluesOnly);
    return std::max(0., solver.eigenvalues()[0] - 1e-9);
}

/// A diagonal matrix that is not larger than R, as its entries.
template <int DIM>
TReading<DIM> diagonalBelow(const TReadingCovariance<DIM>& R) {
    const TReading<DIM> scale = R.diagonal().cwiseSqrt().cwiseInverse();
    const TReadingCovariance<DIM> correlation = scale.asDiagonal() * R * scale.asDiagonal();
    return leastEigenvalue(correlation) * R.diagonal();
}

/// What a landmark's prediction keeps of its covariance when all others are measured as well as
/// `noise` allows (DIM entries per landmark); zero where the matrices are not sound.
template <int DIM>
std::vector<TReadingCovariance<DIM>> remainders(const Eigen::MatrixXd& prediction,
                                                const Eigen::VectorXd& noise) {
    std::vector<TReadingCovariance<DIM>> result(static_cast<std::size_t>(noise.size() / DIM),
                                                TReadingCovariance<DIM>::Zero());
    const Eigen::MatrixXd whole = prediction + Eigen::MatrixXd(noise.asDiagonal());
    const Eigen::LLT<Eigen::MatrixXd> factor(whole);
    if (factor.info() != Eigen::Success) return result;
    const auto information = informationBlocks<DIM>(factor);
    for (std::size_t k = 0; k < result.size(); ++k) {
        const auto row = static_cast<Eigen::Index>(DIM * k);
        TReadingCovariance<DIM> left = information[k].inverse();
        left -= TReadingCovariance<DIM>(noise.segment<DIM>(row).asDiagonal());
        if (left.llt().info() == Eigen::Success) result[k] = left;
    }
    return result;
}

template <int DIM>
double logPeak(const TReadingCovariance<DIM>& covariance) {
    return -std::log(gaussNorm<DIM>() * std::sqrt(covariance.determinant()));
}

template <int DIM>
std::optional<CWhitener<DIM>> whitenerOf(const TReadingCovariance<DIM>& covariance) {
    CWhitener<DIM> whitener;
    if (whitener.set(covariance)) return whitener;
    return {};
}

}  // namespace

template <int DIM>
CHypothesisScore<DIM>::CHypothesisScore(const TAssociationOptions& options,
                                        const TAssociationProblemOf<DIM>& problem,
                                        const CGatedStep<DIM>& step,
                                        const std::vector<TBranch>& branches)
    : m_options(options), m_problem(problem), m_terms(branches.size()) {
    for (std::size_t k = 0; k < branches.size(); ++k)
        for (const TPair& pair : step.pairs(branches[k].observation))
            if (pair.landmark == branches[k].landmark)
                m_terms[k].gain = detectionGain(options, problem.landmarks[pair.landmark]) +
                                  (std::isnan(pair.logRatio) ? 0 : pair.logRatio);
    setBounds(branches, step.identityPairings());
}

template <int DIM>
double CHypothesisScore<DIM>::detectionGain(const TAssociationOptions& options,
                                            const TPredictedLandmarkOf<DIM>& landmark) {
    TDetectability detection =
        landmark.detection.value_or(TDetectability{1, options.detectionProbability});
    detection.found = std::clamp(detection.found, leastDetection, 1 - leastDetection);
    return std::log(detection.found) - std::log1p(-detection.probability());
}

template <int DIM>
void CHypothesisScore<DIM>::setBounds(const std::vector<TBranch>& branches,
                                      const std::vector<TBranch>& given) {
    std::map<std::size_t, TReading<DIM>> noiseOf;  // by landmark: the smallest
    for (const auto* list : {&branches, &given})
        for (const TBranch& branch : *list) {
            const TReading<DIM> noise =
                diagonalBelow<DIM>(m_problem.measurements[branch.observation].R);
            const auto [entry, isFirst] = noiseOf.insert({branch.landmark, noise});
            if (!isFirst) entry->second = entry->second.cwiseMin(noise);
        }
    const auto size = static_cast<Eigen::Index>(DIM * noiseOf.size());
    Eigen::MatrixXd prediction(size, size);
    Eigen::VectorXd noises(size);
    Eigen::Index row = 0;
    for (const auto& [landmark, noise] : noiseOf) {
        noises.segment<DIM>(row) = noise;
        Eigen::Index column = 0;
        for (const auto& other : noiseOf) {
            prediction.block<DIM, DIM>(row, column) =
                m_problem.predictionCovariance.template block<DIM, DIM>(DIM * landmark,
                                                                        DIM * other.first);
            column += DIM;
        }
        row += DIM;
    }
    const std::vector<TReadingCovariance<DIM>> left = remainders<DIM>(prediction, noises);
    for (std::size_t k = 0; k < branches.size(); ++k) {
        const auto entry = noiseOf.find(branches[k].landmark);
        const TReadingCovariance<DIM>& C = left[std::distance(noiseOf.begin(), entry)];
        const TReadingCovariance<DIM>& R = m_problem.measurements[branches[k].observation].R;
        m_terms[k].floor = whitenerOf<DIM>(R + C);
        m_terms[k].bound = m_terms[k].gain + logPeak<DIM>(R + C);
        const TReadingCovariance<DIM> told =
            C + TReadingCovariance<DIM>(entry->second.asDiagonal());
        m_terms[k].lowest = whitenerOf<DIM>(R + C - C * told.inverse() * C);
    }
}

template <int DIM>
double CHypothesisScore<DIM>::unexplained(std::size_t observation) const {
    return m_problem.measurements[observation].kind == ELandmarkKind::corner
               ? m_options.cornerLogDensity
               : m_options.salientLogDensity;
}

template <int DIM>
double CHypothesisScore<DIM>::clutter(std::size_t observation) const {
    return m_problem.measurements[observation].kind == ELandmarkKind::corner
               ? m_options.cornerClutterLogDensity
               : m_options.salientClutterLogDensity;
}

template class CHypothesisScore<2>;
template class CHypothesisScore<3>;

}  // namespace salma::association
