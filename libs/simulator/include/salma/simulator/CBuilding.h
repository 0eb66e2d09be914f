// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>
#include <salma/simulator/CWorld.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace salma::simulator {

/// Numbers are drawn uniformly from here.
struct TSpan {
    double min, max;
};

/// What random buildings are made of.
struct TBuildingOptions {
    int corridors{9};               //!< Wanted; fewer if there is no room for more.
    TSpan corridorWidth{1.6, 2.6};  //!< [m]
    TSpan corridorLength{8, 20};    //!< Of the part that is no junction with its parent [m].
    TSpan roomSize{4.5, 7.5};       //!< Width and depth, each [m].
    TSpan doorWidth{0.8, 0.95};     //!< [m]
    double openShare{0.4};          //!< Probability that a door stands open.
    double clutterPerMetre{0.08};   //!< Boxes along each corridor [1/m].
    int clutterPerRoom{4};          //!< At most.

    /// \throw std::invalid_argument if a span is empty or a size too small to stand in.
    void validate() const;
};

/// A rectangle along the axes.
struct TArea {
    double x0, y0, x1, y1;  //!< [m]

    bool contains(double x, double y) const { return x >= x0 && x <= x1 && y >= y0 && y <= y1; }
    bool overlaps(const TArea& o) const { return x0 < o.x1 && o.x0 < x1 && y0 < o.y1 && o.y0 < y1; }
};

struct TCorridor {
    TArea area;
    bool alongX;  //!< Else along y.
};

struct TDoorway {
    TArea area;  //!< Through the wall, or of the recess before a shut leaf.
    bool open;
    std::size_t corridor;  //!< Index into corridors().
    std::size_t room;      //!< Index into rooms().
};

/// A point where a robot may turn, and where it can go from there on a straight clear way.
struct TStation {
    mrpt::math::TPoint2D at;
    std::vector<std::size_t> next;
};

/** A random building at the height of the laser: corridors that branch off each other, rooms with
 * doors open and shut, boxes and furniture.
 *
 * Corridors make a tree: a child begins at a side of its parent, somewhere (a T) or at its end (an
 * L; two of them facing each other are a T again). Everything but the furniture is square. The
 * same options and seed give the same building on every platform. */
class CBuilding {
 public:
    /// \throw std::invalid_argument as TBuildingOptions::validate().
    CBuilding(const TBuildingOptions& options, std::uint32_t seed);

    const std::vector<TCorridor>& corridors() const { return m_corridors; }
    const std::vector<TArea>& rooms() const { return m_rooms; }
    const std::vector<TDoorway>& doorways() const { return m_doorways; }
    const std::vector<TStation>& stations() const { return m_stations; }

    /// All that a beam can hit.
    const std::vector<TSegment>& segments() const { return m_segments; }

    /// Distance to the nearest thing that a beam can hit [m].
    double clearance(const mrpt::math::TPoint2D& p) const;

    /// True if the point lies in a corridor.
    bool inCorridor(const mrpt::math::TPoint2D& p) const;

 private:
    friend class CBuildingBuilder;
    std::vector<TCorridor> m_corridors;
    std::vector<TArea> m_rooms;
    std::vector<TDoorway> m_doorways;
    std::vector<TStation> m_stations;
    std::vector<TSegment> m_segments;
};

/** A robot that wanders from station to station: straight on in steps of 0.2 m, swaying a little,
 * turning on the spot in steps of 15 deg.
 * \return Poses of the robot in the building; `steps` of them. */
std::vector<mrpt::math::TPose2D> wander(const CBuilding& building,
                                        std::uint32_t seed,
                                        std::size_t steps);

}  // namespace salma::simulator
