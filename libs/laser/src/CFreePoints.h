// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/laser/CLineExtractor.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "fitLine.h"

namespace salma::laser {

/// The unbroken run of points along a line.
struct TRun {
    std::uint32_t first{0}, last{0};  //!< Its outermost points.
    std::uint32_t points{0};
    float support{0};  //!< Number of points, each counting less the farther it lies off.
};

/// The points of one scan, and which of them belong to no line yet.
class CFreePoints {
 public:
    CFreePoints(const TLineOptions& options,
                const std::vector<TBeam>& beams,
                const TBeamNoise& noise);

    std::size_t size() const { return m_beams.size(); }
    const TBeam& operator[](std::size_t i) const { return m_beams[i]; }
    const std::vector<TBeam>& beams() const { return m_beams; }
    const TBeamNoise& noise() const { return m_noise; }

    bool isFree(std::size_t i) const { return m_free[i] != 0; }
    void take(const Members& members);

    /// Does the free point lie on the line?
    bool fits(const TFit& fit, std::size_t i) const { return offset(fit, i) <= 1; }

    /// The run around `seed`, without its members.
    TRun measure(const TFit& fit, std::uint32_t seed) const;

    /// The members of the run around `seed`, in order.
    void collect(const TFit& fit, std::uint32_t seed, Members& members) const;

 private:
    /** Squared distance to the line by the squared tolerance, NaN for points that are not free.
     * Less is tolerated on walls seen at a slant, whose points are exact. */
    float offset(const TFit& fit, std::size_t i) const;

    /// Calls use(i, offset) for each member beyond `seed` in one direction.
    template <int STEP, class USE>
    void extend(const TFit& fit, std::uint32_t seed, USE&& use) const;

    struct TBlock;
    struct TNarrowFit;
    void evaluate(const TNarrowFit& fit, std::size_t first, TBlock& block) const;

    const std::vector<TBeam>& m_beams;
    TBeamNoise m_noise;
    float m_gap;
    float m_inlier2, m_roughness2, m_rangeVariance, m_bearingVariance;
    /// Ends of the free beams, NaN for others, and all directions, each with a block of margin on
    /// either side: the inner loop runs over them in blocks.
    std::vector<float> m_x, m_y, m_cosine, m_sine;
    std::vector<std::uint8_t> m_free;
};

}  // namespace salma::laser
