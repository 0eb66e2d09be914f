// SPDX-License-Identifier: BSD-3-Clause
#include "CLandmarkRegister.h"

namespace salma::simulator {

CLandmarkRegister::CLandmarkRegister(const TWorld& description) {
    for (const bool moved : {false, true})
        for (const auto& wall : description.walls)
            for (const auto& poster : description.posters)
                if (poster.wall == wall.name && (!moved || poster.movedInLap > 0)) {
                    const int id = static_cast<int>(m_posters.size()) + 1;
                    m_posters[{poster.name, moved}] = id;
                }
    m_landmarks.resize(m_posters.size());
    m_floors.resize(m_posters.size(), 0);
}

void CLandmarkRegister::addPoster(const std::string& name, bool moved, TTrueLandmark& landmark) {
    landmark.id = m_posters.at({name, moved});
    m_landmarks[static_cast<std::size_t>(landmark.id) - 1] = landmark;
}

void CLandmarkRegister::addCorner(int floor, TTrueLandmark& landmark) {
    for (std::size_t i = m_posters.size(); i < m_landmarks.size(); ++i)
        if (m_floors[i] == floor && (m_landmarks[i].centre - landmark.centre).norm() < 1e-5) {
            landmark.id = m_landmarks[i].id;
            return;
        }
    landmark.id = static_cast<int>(m_landmarks.size()) + 1;
    m_landmarks.push_back(landmark);
    m_floors.push_back(floor);
}

}  // namespace salma::simulator
