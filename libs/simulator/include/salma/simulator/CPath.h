// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>
#include <salma/simulator/TWorld.h>

#include <cstdint>
#include <vector>

namespace salma::simulator {

/** The true motion of the robot: straight lines joined by arcs, driven at a speed that keeps to the
 * greatest turn rate and acceleration, from standstill to standstill. */
class CPath {
 public:
    /// \throw std::invalid_argument saying why the points cannot be driven.
    explicit CPath(const TPathOptions& options, std::uint32_t seed = 0);

    double duration() const { return m_times.back(); }  //!< Of all laps [s].
    double lapLength() const { return m_lapLength; }    //!< [m]
    /// Number of the lap, from 1 on, and floor of the building at `time` [s].
    int lap(double time) const;
    int floor(double time) const;

    /// T_w_p: `distance` [m] along the lap, to the left by `aside` [m], without swaying.
    mrpt::math::TPose2D beside(double distance, double aside) const;
    int floorAt(double lapDistance) const { return pieceAt(lapDistance).floor; }

    /// When the first lap ends [s].
    double firstLapEnd() const;

    /// T_w_r at `time` [s] after the start; the ends are held.
    mrpt::math::TPose2D pose(double time) const;

 private:
    /// A straight piece (curvature 0) or an arc.
    struct TPiece {
        double start;      //!< Arc length at its start [m].
        double length;     //!< [m]
        double curvature;  //!< Left is positive [1/m].
        mrpt::math::TPose2D from;
        int floor;
    };
    void addPieces(const std::vector<mrpt::math::TPoint2D>& points);
    void planSpeed();
    const TPiece& pieceAt(double lapDistance) const;
    double distance(double time) const;

    TPathOptions m_options;
    double m_phase;  //!< Of the swaying [rad].
    std::vector<TPiece> m_pieces;
    double m_lapLength{0};
    std::vector<double> m_speeds;  //!< At each step of kStep along all laps [m/s].
    std::vector<double> m_times;   //!< When that step is reached [s].
};

}  // namespace salma::simulator
