// SPDX-License-Identifier: BSD-3-Clause
#include "CAssociationScore.h"

namespace salma::apps {

using slam::EDecision;

std::size_t TAssociationFigures::duplicateLandmarks() const {
    std::size_t n = 0;
    for (const auto& duplicate : duplicates) n += duplicate.landmarks.size() - 1;
    return n;
}

void CAssociationScore::add(const slam::TAssociationRow& row, int truth) {
    ++m_figures.observations;
    if (truth < 0) ++m_figures.falseEntities;
    const auto since = m_mappedSince.find(truth);
    const bool again = since != m_mappedSince.end() && since->second < row.time;
    if (again) ++m_resightings;
    if (again && row.decision == EDecision::deferred) ++m_figures.deferred;
    if (row.landmark < 0) return;
    const bool isPairing =
        row.decision == EDecision::paired || row.decision == EDecision::relocated;
    const bool makes = row.decision == EDecision::created || row.decision == EDecision::provisional;
    if (m_truthOf.count(row.landmark) == 0) {
        if (makes || isPairing) addLandmark(row, truth);
    } else if (isPairing && judge(row, truth) && again) {
        ++m_recalled;
    }
}

void CAssociationScore::addLandmark(const slam::TAssociationRow& row, int truth) {
    const bool wasThere =  // in a map that the run started on
        row.decision == EDecision::paired || row.decision == EDecision::relocated;
    m_truthOf[row.landmark] = truth;
    if (wasThere)
        ++m_figures.unjudged;
    else
        ++m_figures.landmarksMade;
    if (truth < 0) {
        ++m_figures.falseLandmarks;
    } else {
        m_landmarksOf[truth].push_back(row.landmark);
        m_mappedSince.emplace(truth, row.time);
    }
}

bool CAssociationScore::judge(const slam::TAssociationRow& row, int truth) {
    const int mapped = m_truthOf.at(row.landmark);
    if (mapped < 0 && truth < 0) {
        ++m_figures.unjudged;
        return false;
    }
    if (mapped == truth) {
        ++m_right;
        return true;
    }
    if (mapped >= 0 && truth >= 0)
        m_figures.wrong.push_back({row.time, row.observation, row.landmark, mapped, truth});
    else
        ++m_figures.wrongWithFalse;
    return false;
}

TAssociationFigures CAssociationScore::figures(std::size_t trueLandmarks) const {
    TAssociationFigures figures = m_figures;
    figures.trueLandmarks = trueLandmarks;
    figures.precision =
        proportion(m_right, m_right + m_figures.wrong.size() + m_figures.wrongWithFalse);
    figures.recall = proportion(m_recalled, m_resightings);
    figures.landmarksCovered = m_landmarksOf.size();
    for (const auto& [truth, landmarks] : m_landmarksOf)
        if (landmarks.size() > 1) figures.duplicates.push_back({truth, landmarks});
    return figures;
}

}  // namespace salma::apps
