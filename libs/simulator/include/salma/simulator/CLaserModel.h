// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <salma/simulator/CWorld.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace salma::simulator {

/** A SICK LMS 200 that casts rays into a world.
 *
 * Range noise is normal; an offset drawn once per run is added to every range; a beam that falls on
 * an edge may return a range between the two sides. Ranges are whole multiples of the mode's step.
 * Source: Ho, transfer report 2004, section 4.4.1; mixing and offset: own. */
class CLaserModel {
 public:
    CLaserModel(const TLaserOptions& options, const CWorld& world, std::uint32_t seed);

    /// In a world without height: `segments` are all that a beam can hit.
    CLaserModel(const TLaserOptions& options, std::vector<TSegment> segments, std::uint32_t seed);

    /** \param T_w_r Pose of the robot. \param index Number of the scan, which selects its noise.
     * \return A scan without time stamp; beams beyond the mode's range are invalid. */
    mrpt::obs::CObservation2DRangeScan scan(const mrpt::math::TPose2D& T_w_r,
                                            std::uint64_t index) const;

    /// The same laser with more that its beams can hit.
    CLaserModel with(const std::vector<TSegment>& obstacles) const;

    /// Range along each beam, without any noise [m]; infinity where nothing is hit.
    std::vector<double> trueRanges(const mrpt::math::TPose2D& T_w_r) const;

    /// Index into segments() of what the middle of each beam hits; -1 where nothing is hit.
    std::vector<int> trueSegments(const mrpt::math::TPose2D& T_w_r) const;

    /// What the beams can hit, in the world.
    const std::vector<TSegment>& segments() const { return m_segments; }

    /// Constant error of this run's ranges [m].
    double offset() const { return m_offset; }

 private:
    struct THit {
        double range;
        std::size_t segment;
    };
    std::vector<THit> castAll(const mrpt::math::TPose2D& T_w_l) const;
    double castOne(const mrpt::math::TPoint2D& from, double angle) const;
    mrpt::math::TPose2D laserPose(const mrpt::math::TPose2D& T_w_r) const;
    std::optional<double> mixed(const mrpt::math::TPose2D& T_w_l, double angle, double share) const;

    TLaserOptions m_options;
    std::vector<TSegment> m_segments;
    std::uint32_t m_seed;
    double m_offset;
};

}  // namespace salma::simulator
