// SPDX-License-Identifier: BSD-3-Clause
#include <salma/simulator/CScenes.h>

#include "CLandmarkRegister.h"
#include "CTextureStore.h"

namespace salma::simulator {
namespace {

/// True if nothing changes from the lap before.
bool isLikeBefore(const TWorld& world, int lap) {
    for (const auto& door : world.doors)
        if (door.isOpen(lap) != door.isOpen(lap - 1)) return false;
    for (const auto& poster : world.posters)
        if (poster.isMoved(lap) != poster.isMoved(lap - 1)) return false;
    return true;
}

std::set<int> floorsOf(const TPathOptions& path) {
    std::set<int> floors;
    for (const double floor : path.floors) floors.insert(static_cast<int>(floor));
    if (floors.empty()) floors.insert(1);
    return floors;
}

}  // namespace

std::set<const CWorld*> CScenes::all() const {
    std::set<const CWorld*> worlds;
    for (const auto& entry : m_worlds) worlds.insert(entry.second.get());
    return worlds;
}

CScenes::CScenes(const TWorld& description) {
    CTextureStore textures(description.file.parent_path());
    CLandmarkRegister landmarks(description);
    for (int lap = 1; lap <= description.path.laps; ++lap)
        for (const int floor : floorsOf(description.path))
            m_worlds[{lap, floor}] =
                lap > 1 && isLikeBefore(description, lap)
                    ? m_worlds.at({lap - 1, floor})
                    : std::make_shared<CWorld>(description, lap, floor, textures, landmarks);
    // a poster that is moved after the last lap has an id but no place
    for (const auto& landmark : landmarks.landmarks())
        if (landmark.id > 0) m_landmarks.push_back(landmark);
}

}  // namespace salma::simulator
