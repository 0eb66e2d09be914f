// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/simulator/CWorld.h>

#include <map>
#include <string>
#include <vector>

namespace salma::simulator {

/// Gives each landmark one id, whatever lap or floor it is met in.
class CLandmarkRegister {
 public:
    /// Posters get their ids here: wall by wall, then again those that are moved.
    explicit CLandmarkRegister(const TWorld& description);

    /// Id of a poster, before or after its move. \param landmark Its other fields.
    void addPoster(const std::string& name, bool moved, TTrueLandmark& landmark);

    /// Id of the corner at that place of that floor; a new one if it was not met yet.
    void addCorner(int floor, TTrueLandmark& landmark);

    /// In the order of their ids.
    const std::vector<TTrueLandmark>& landmarks() const { return m_landmarks; }

 private:
    std::map<std::pair<std::string, bool>, int> m_posters;
    std::vector<int> m_floors;  //!< Of each landmark; 0 for posters.
    std::vector<TTrueLandmark> m_landmarks;
};

}  // namespace salma::simulator
