// SPDX-License-Identifier: BSD-3-Clause
// Landmarks that are looked for in vain go.
#include <salma/slam/CSalientEKF2D.h>

#include <algorithm>

namespace salma::slam {

namespace {

constexpr std::size_t leastPairings = 3;  // in a step of a robot that knows where it is
constexpr double sharpEnough = 0.1;       // sigma of a prediction that says where to look [m]

}  // namespace

/// Most of what a scan shows is known: a robot that is lost removes nothing.
bool CSalientEKF2D::knowsPlace() const {
    const auto paired = static_cast<std::size_t>(
        std::count(m_now.decisions.begin(), m_now.decisions.end(), EDecision::paired));
    return paired >= leastPairings && 2 * paired >= m_now.decisions.size();
}

/// Whether a landmark is sharply predicted and nothing that was measured could be it.
bool CSalientEKF2D::isMissing(std::size_t landmark) const {
    const auto& [sigmas, evidence, problem, association] = *m_now.judgement;
    if (landmark >= sigmas.size() || sigmas[landmark] > sharpEnough) return false;
    return std::none_of(association.candidates.begin(), association.candidates.end(),
                        [landmark](const auto& c) { return c.landmark == landmark; });
}

void CSalientEKF2D::removeAbsent() {
    if (!(m_ekf.removeAfter > 0)) return;
    if (m_now.input.scanned) m_knowsPlace = knowsPlace();
    std::vector<bool> seen(m_landmarks.size(), false);
    for (const int index : m_now.landmarks)
        if (index >= 0) seen[static_cast<std::size_t>(index)] = true;
    std::vector<std::size_t> gone;
    for (std::size_t k = 0; k < m_landmarks.size(); ++k) {
        const int id = m_landmarks[k].id;
        const Eigen::Vector2d back =
            poseMean().head<2>() - Eigen::Vector2d(m_xkk[3 + 2 * k], m_xkk[4 + 2 * k]);
        if (seen[k])
            m_looks.see(id, back);
        else if (m_knowsPlace && isMissing(k) &&
                 m_looks.miss(id, back, m_history.back().travel,
                              m_now.judgement->problem.landmarks[k].detection->probability()) >=
                     m_ekf.removeAfter)
            gone.push_back(k);
    }
    for (auto k = gone.rbegin(); k != gone.rend(); ++k) remove(*k);
}

void CSalientEKF2D::remove(std::size_t landmark) {
    const int id = m_landmarks[landmark].id;
    const Eigen::Index size = m_xkk.size(), row = 3 + 2 * static_cast<Eigen::Index>(landmark);
    const Eigen::Index after = size - row - 2;
    Eigen::VectorXd mean(size - 2);
    mean << m_xkk.asEigen().head(row), m_xkk.asEigen().tail(after);
    const RowMatrix P = m_pkk.asEigen();
    RowMatrix covariance(size - 2, size - 2);
    covariance << P.topLeftCorner(row, row), P.topRightCorner(row, after),
        P.bottomLeftCorner(after, row), P.bottomRightCorner(after, after);
    m_xkk.resize(size - 2);
    m_pkk.setSize(size - 2, size - 2);
    TFilterState now = state();
    now.mean = mean;
    now.covariance = covariance;
    m_landmarks.erase(landmark);
    m_IDs.clear();
    for (std::size_t i = 0; i < m_landmarks.size(); ++i)
        m_IDs.insert(m_landmarks[i].id, static_cast<unsigned>(i));
    for (int& other : m_now.landmarks)
        if (other > static_cast<int>(landmark)) --other;
    auto& sigmas = m_now.judgement->sigmas;
    sigmas.erase(sigmas.begin() + static_cast<std::ptrdiff_t>(landmark));
    m_history.erase(id);
    m_lastUsed.erase(id);
    m_looks.forget(id);
    ++m_record.removed;
}

}  // namespace salma::slam
