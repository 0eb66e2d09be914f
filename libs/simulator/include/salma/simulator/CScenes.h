// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/simulator/CWorld.h>

#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace salma::simulator {

/** A world whose doors and posters differ from lap to lap, and which may have several floors: one
 * CWorld for each floor in each lap that looks different. A landmark has one id in all of them; a
 * poster that is moved has another id from then on. */
class CScenes {
 public:
    /// \throw std::runtime_error if a texture cannot be read.
    explicit CScenes(const TWorld& description);

    /// \throw std::out_of_range
    const CWorld& at(int lap, int floor) const { return *m_worlds.at({lap, floor}); }

    /// Each that is different.
    std::set<const CWorld*> all() const;

    /// Of all laps and floors, in the order of their ids, which count from 1.
    const std::vector<TTrueLandmark>& landmarks() const { return m_landmarks; }

 private:
    std::map<std::pair<int, int>, std::shared_ptr<const CWorld>> m_worlds;  //!< By lap and floor.
    std::vector<TTrueLandmark> m_landmarks;
};

}  // namespace salma::simulator
