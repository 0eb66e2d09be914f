// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/simulator/CBuilding.h>

#include <vector>

#include "seeds.h"

namespace salma::simulator {

/// Grows a building: corridors, then rooms, then the ways through them, then what stands around.
class CBuildingBuilder {
 public:
    CBuildingBuilder(const TBuildingOptions& options, std::uint32_t seed, CBuilding& building);
    void build();

 private:
    /// Where a corridor branches off.
    struct TBranch {
        std::size_t parent;
        double at;     //!< Middle of the branch along the parent [m].
        bool atStart;  //!< Flush with the parent's first end ...
        bool atEnd;    //!< ... or its second.
    };

    double draw(const TSpan& span) { return m_random.uniform(span.min, span.max); }
    bool chance(double probability) { return m_random.unit() < probability; }
    std::size_t pick(std::size_t count) { return m_random.bits() % count; }

    void addCorridors();
    void addBranch();
    bool fits(const TArea& area, double margin, std::size_t except) const;

    void addRooms();
    void addRoom(std::size_t corridor, bool highSide, double from);

    void addStations();
    std::size_t station(const mrpt::math::TPoint2D& at);
    void join(std::size_t a, std::size_t b);
    void joinCorridor(std::size_t corridor);
    void joinRoom(const TDoorway& door, std::size_t onAxis);

    void addWalls();
    void addClutter();
    void addBoxAtWall(const TArea& area, bool alongX, double maxDepth);
    void addLooseBox(const TArea& room);
    bool clearOfWays(const std::vector<mrpt::math::TPoint2D>& outline, double distance) const;
    void addOutline(const std::vector<mrpt::math::TPoint2D>& outline);

    const TBuildingOptions& m_options;
    CRandom m_random;
    CBuilding& m_building;
    std::vector<TBranch> m_branches;  //!< Of each corridor; that of the first means nothing.
};

}  // namespace salma::simulator
