// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <salma/simulator/CWorld.h>

#include <cstdint>
#include <vector>

namespace salma::simulator {

class CRandom;

/// How a nodding mount sweeps.
struct TNoddingOptions {
    double lowest{mrpt::DEG2RAD(-20.0)};  //!< Elevation of the first scan's middle beam [rad].
    double highest{mrpt::DEG2RAD(40.0)};  //!< Of the last scan's [rad].
    int scans{61};                        //!< At least 2.
};

/** A LMS 200 that nods about a level axis through its mirror while the robot stands still.
 *
 * Rays are cast against all faces of the world, floor and lids too. Noise, offset, rounding and
 * ranges between two faces are those of CLaserModel.
 * Source: Ho, transfer report 2004, section 4.4.1 (-20 to +40 deg). */
class CNoddingLaserModel {
 public:
    /// \throw std::invalid_argument if options are out of range. \param world Must outlive this.
    CNoddingLaserModel(const TLaserOptions& options,
                       const TNoddingOptions& nodding,
                       const CWorld& world,
                       std::uint32_t seed);

    /** \param T_w_r Pose of the robot. \param index Number of the sweep, which selects its noise.
     * \return The scans from below upwards, each with its pose on the robot, without stamps. */
    std::vector<mrpt::obs::CObservation2DRangeScan> sweep(const mrpt::math::TPose2D& T_w_r,
                                                          std::uint64_t index) const;

    /** One scan while the mount moves from elevation `first` (that of the rightmost beam) to `last`
     * [rad]. \param index Number of the scan, which selects its noise.
     * \return With the pose that its middle beam has, without stamp. */
    mrpt::obs::CObservation2DRangeScan scan(const mrpt::math::TPose2D& T_w_r,
                                            double first,
                                            double last,
                                            std::uint64_t index) const;

 private:
    struct THit {
        double range;
        int face;  //!< -1 for none.
    };
    mrpt::obs::CObservation2DRangeScan scan(const mrpt::math::TPose2D& T_w_r,
                                            double first,
                                            double last,
                                            CRandom& random) const;
    THit cast(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) const;

    TLaserOptions m_options;
    TNoddingOptions m_nodding;
    const CWorld& m_world;
    std::uint32_t m_seed;
    double m_offset;
};

}  // namespace salma::simulator
