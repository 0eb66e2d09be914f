// SPDX-License-Identifier: BSD-3-Clause
#include "CGatedStep.h"

#include <mrpt/math/wrap2pi.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <tuple>

#include "CChiSquareGate.h"

namespace salma::association {
namespace {

template <int DIM>
void check(const TAssociationProblemOf<DIM>& problem) {
    const Eigen::MatrixXd& covariance = problem.predictionCovariance;
    const auto size = static_cast<Eigen::Index>(DIM * problem.landmarks.size());
    if (covariance.rows() != size || covariance.cols() != size)
        throw std::invalid_argument("Prediction covariance is " +
                                    std::to_string(covariance.rows()) + " x " +
                                    std::to_string(covariance.cols()) + ", not " +
                                    std::to_string(size) + " x " + std::to_string(size));
    if (!covariance.allFinite())
        throw std::invalid_argument("Prediction covariance of " +
                                    std::to_string(problem.landmarks.size()) +
                                    " landmarks is not finite");
    for (std::size_t i = 0; i < problem.landmarks.size(); ++i) {
        if (!problem.landmarks[i].z.allFinite())
            throw std::invalid_argument("Prediction of landmark " + std::to_string(i) +
                                        " is not finite");
        const TDetectability detection = problem.landmarks[i].detection.value_or(TDetectability());
        for (const double value : {detection.inView, detection.found})
            if (!(value >= 0 && value <= 1))
                throw std::invalid_argument("Detection probability of landmark " +
                                            std::to_string(i) + " is " + std::to_string(value) +
                                            ", not from 0 to 1");
    }
}

}  // namespace

template <int DIM>
CGatedStep<DIM>::CGatedStep(const TAssociationOptions& options,
                            const TAssociationProblemOf<DIM>& problem)
    : m_options(options),
      m_problem(problem),
      m_gate(chiSquareQuantile(options.gateQuantile, DIM)),
      m_wallGate2(chiSquareQuantile(options.wallAngleQuantile, 1)),
      m_joint(problem),
      m_pairs(problem.measurements.size()),
      m_open(problem.measurements.size(), true),
      m_taken(problem.landmarks.size(), false) {
    check(problem);
    m_result.decisions.resize(problem.measurements.size());
    rejectClutter();
    refuseExcess();
    pairIdentities();
    m_identityDistance2 = m_joint.distance2();
    for (std::size_t i = 0; i < problem.measurements.size(); ++i)
        if (m_open[i]) gate(i);
}

template <int DIM>
void CGatedStep<DIM>::rejectClutter() {
    std::set<int> identities;
    for (std::size_t i = 0; i < m_problem.measurements.size(); ++i) {
        const TMeasurementOf<DIM>& measurement = m_problem.measurements[i];
        if (!measurement.z.allFinite() || !(measurement.z[0] > 0) || !measurement.R.allFinite())
            decide(i, EVerdict::clutter, EReason::notFinite);
        else if (measurement.R.llt().info() != Eigen::Success)
            decide(i, EVerdict::clutter, EReason::badCovariance);
        else if (measurement.identity && !identities.insert(*measurement.identity).second)
            decide(i, EVerdict::clutter, EReason::repeatedIdentity);
    }
}

template <int DIM>
void CGatedStep<DIM>::refuseExcess() {
    const auto limit = static_cast<std::size_t>(m_options.maxMeasurements);
    if (openCount() <= limit) return;
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < m_open.size(); ++i)
        if (m_open[i]) order.push_back(i);
    std::sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
        const TMeasurementOf<DIM>& first = m_problem.measurements[a];
        const TMeasurementOf<DIM>& second = m_problem.measurements[b];
        return std::make_tuple(!first.identity, first.z[0], first.z[1], a) <
               std::make_tuple(!second.identity, second.z[0], second.z[1], b);
    });
    for (std::size_t k = limit; k < order.size(); ++k)
        decide(order[k], EVerdict::deferred, EReason::tooMany);
}

template <int DIM>
void CGatedStep<DIM>::pairIdentities() {
    for (std::size_t i = 0; i < m_problem.measurements.size(); ++i) {
        const auto& identity = m_problem.measurements[i].identity;
        if (!m_open[i] || !identity) continue;
        for (std::size_t j = 0; j < m_problem.landmarks.size(); ++j) {
            if (m_problem.landmarks[j].identity != identity || m_taken[j]) continue;
            const auto test = CJointInnovationOf<DIM>(m_problem).test(i, j);
            if (test && m_joint.test(i, j)) {
                TPair known;
                known.landmark = j;
                known.distance2 = test->distance2;
                known.inGate = known.distance2 <= m_gate;
                m_pairs[i] = {known};
                pair(i, j, EReason::identity);
                m_identities.push_back({i, j});
            } else {
                ++m_result.dropped.singular;
                decide(i, EVerdict::clutter, EReason::badCovariance);
            }
            break;
        }
    }
}

template <int DIM>
bool CGatedStep<DIM>::compatible(const TMeasurementOf<DIM>& measurement,
                                 const TPredictedLandmarkOf<DIM>& landmark) {
    TDropCounts& dropped = m_result.dropped;
    if (!landmark.visible) return ++dropped.invisible, false;
    if (measurement.kind != landmark.kind ||
        (measurement.kind == ELandmarkKind::corner && measurement.convex != landmark.convex))
        return ++dropped.kind, false;
    if (measurement.identity && landmark.identity && measurement.identity != landmark.identity)
        return ++dropped.identity, false;
    if (std::isnan(measurement.wallAngle) || std::isnan(landmark.wallAngle)) return true;
    const double turn = mrpt::math::wrapToPi(measurement.wallAngle - landmark.wallAngle);
    const double variance = measurement.wallAngleSigma * measurement.wallAngleSigma +
                            landmark.wallAngleSigma * landmark.wallAngleSigma;
    if (!(turn * turn <= m_wallGate2 * variance)) return ++dropped.wallAngle, false;
    return true;
}

template <int DIM>
void CGatedStep<DIM>::gate(std::size_t observation) {
    const CJointInnovationOf<DIM> alone(m_problem);
    for (std::size_t j = 0; j < m_problem.landmarks.size(); ++j) {
        if (m_taken[j]) {  // by an identity
            ++m_result.dropped.identity;
            continue;
        }
        if (!compatible(m_problem.measurements[observation], m_problem.landmarks[j])) continue;
        const auto test = alone.test(observation, j);
        if (!test) {
            ++m_result.dropped.singular;
            continue;
        }
        TPair pair;
        pair.landmark = j;
        pair.distance2 = test->distance2;
        pair.inGate = pair.distance2 <= m_gate;
        if (!pair.inGate) ++m_result.dropped.distance;
        if (pair.inGate || pair.distance2 <= m_options.newDistance2)
            m_pairs[observation].push_back(pair);
    }
}

template <int DIM>
bool CGatedStep<DIM>::passesJointGate(const TConditionalInnovationOf<DIM>& more) const {
    const auto pairings = static_cast<unsigned>(m_joint.pairings() - m_identities.size() + 1);
    const double total = m_joint.distance2() - m_identityDistance2 + more.distance2;
    return total <= chiSquareQuantile(m_options.jointQuantile, DIM * pairings);
}

template <int DIM>
void CGatedStep<DIM>::weighAppearance() {
    if (!m_problem.logRatio) return;
    for (std::size_t i = 0; i < m_pairs.size(); ++i) {
        if (!m_open[i] || m_problem.measurements[i].kind != ELandmarkKind::salient) continue;
        for (TPair& pair : m_pairs[i]) {
            pair.logRatio = m_problem.logRatio(i, pair.landmark);
            pair.forbidden = pair.logRatio <= m_options.forbidLogLr;
            if (pair.forbidden && pair.inGate) ++m_result.dropped.appearance;
        }
    }
}

template <int DIM>
void CGatedStep<DIM>::decide(std::size_t observation, EVerdict verdict, EReason reason) {
    m_open[observation] = false;
    m_result.decisions[observation].verdict = verdict;
    m_result.decisions[observation].reason = reason;
}

template <int DIM>
std::size_t CGatedStep<DIM>::openCount() const {
    return static_cast<std::size_t>(std::count(m_open.begin(), m_open.end(), true));
}

template <int DIM>
std::vector<TBranch> CGatedStep<DIM>::branches(bool outsideGateToo) const {
    std::vector<TBranch> result;
    for (std::size_t i = 0; i < m_pairs.size(); ++i)
        for (const TPair& pair : m_pairs[i])
            if (m_open[i] && (pair.inGate || outsideGateToo) && !pair.forbidden)
                result.push_back({i, pair.landmark});
    return result;
}

template <int DIM>
void CGatedStep<DIM>::pair(std::size_t observation, std::size_t landmark, EReason reason) {
    const TPair& pair = pairOf({observation, landmark});
    m_joint.add(observation, landmark);
    m_taken[landmark] = true;
    decide(observation, EVerdict::paired, reason);
    TDecision& decision = m_result.decisions[observation];
    decision.landmark = static_cast<int>(landmark);
    decision.distance2 = pair.distance2;
    decision.logRatio = pair.logRatio;
    ++m_result.pairings;
    if (!std::isnan(pair.logRatio)) m_result.logRatio += pair.logRatio;
}

template <int DIM>
const TPair& CGatedStep<DIM>::pairOf(const TBranch& branch) const {
    const auto& pairs = m_pairs[branch.observation];
    return *std::find_if(pairs.begin(), pairs.end(),
                         [&](const TPair& pair) { return pair.landmark == branch.landmark; });
}

template <int DIM>
void CGatedStep<DIM>::defer(std::size_t observation, EReason reason) {
    decide(observation, EVerdict::deferred, reason);
}

template <int DIM>
EReason CGatedStep<DIM>::whyUnpaired(std::size_t observation) {
    bool impossible = false;
    for (const TPair& pair : m_pairs[observation]) {
        if (!pair.inGate || pair.forbidden || m_taken[pair.landmark]) continue;
        impossible = true;
        ++m_result.dropped.joint;
    }
    return impossible ? EReason::jointlyImpossible : EReason::taken;
}

template <int DIM>
bool CGatedStep<DIM>::isNear(std::size_t observation, const TPair& pair, bool givenPairings) const {
    if (pair.forbidden) return false;
    if (!givenPairings) return true;
    const auto test = m_joint.test(observation, pair.landmark);
    return !test || test->distance2 <= m_options.newDistance2;
}

template <int DIM>
void CGatedStep<DIM>::settle(std::size_t observation, EReason reason, bool givenPairings) {
    bool near = false;
    bool hasCandidate = false;
    for (const TPair& pair : m_pairs[observation]) {
        near = near || isNear(observation, pair, givenPairings);
        hasCandidate = hasCandidate || (pair.inGate && !pair.forbidden);
    }
    if (near)
        decide(observation, EVerdict::deferred, hasCandidate ? reason : EReason::nearLandmark);
    else
        decide(observation, EVerdict::created,
               m_problem.measurements[observation].identity ? EReason::identity
                                                            : EReason::unexplained);
}

template <int DIM>
TAssociation CGatedStep<DIM>::finish(const TSearchCounts& search) {
    m_result.search = search;
    for (std::size_t i = 0; i < m_pairs.size(); ++i) {
        TDecision& decision = m_result.decisions[i];
        for (const TPair& pair : m_pairs[i]) {
            const bool chosen = decision.landmark == static_cast<int>(pair.landmark);
            if (pair.inGate || chosen) ++decision.candidates;
            m_result.candidates.push_back(
                {i, pair.landmark, pair.distance2, pair.logRatio, chosen, pair.inGate});
        }
    }
    m_result.jointDistance2 = m_joint.distance2();
    return std::move(m_result);
}

template class CGatedStep<2>;
template class CGatedStep<3>;

}  // namespace salma::association
