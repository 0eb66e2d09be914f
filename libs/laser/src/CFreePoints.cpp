// SPDX-License-Identifier: BSD-3-Clause
#include "CFreePoints.h"

#include <array>
#include <cmath>
#include <limits>

namespace salma::laser {
namespace {

constexpr double kRoughness = 0.012;  // walls are no flatter than this [m]
constexpr double kSigmas = 4;         // points of a line lie within so many sigma, or kRoughness
constexpr float kFacing = 0.01;       // cosine at which a beam is as good as parallel to a wall
constexpr float kSlant = 4;  // neighbouring beams on a slanting wall lie so many gaps apart

constexpr std::size_t kBlock = 8;  // points that are looked at together
constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();

float squared(double x) { return static_cast<float>(x * x); }

}  // namespace

/// A line in the precision of the search.
struct CFreePoints::TNarrowFit {
    explicit TNarrowFit(const TFit& fit)
        : rho(static_cast<float>(fit.rho)),
          cosine(static_cast<float>(fit.cosine)),
          sine(static_cast<float>(fit.sine)) {}
    float rho, cosine, sine;
};

/// Neighbouring points as seen from a line.
struct CFreePoints::TBlock {
    std::array<float, kBlock> offset;  //!< As offset().
    std::array<float, kBlock> along;   //!< Where on the line [m].
    std::array<float, kBlock> facing;  //!< Cosine between the beam and the line's normal.
};

CFreePoints::CFreePoints(const TLineOptions& options,
                         const std::vector<TBeam>& beams,
                         const TBeamNoise& noise)
    : m_beams(beams),
      m_noise(noise),
      m_gap(static_cast<float>(options.gap)),
      m_inlier2(squared(std::max(options.inlier, kSigmas * noise.range))),
      m_roughness2(squared(kRoughness)),
      m_rangeVariance(squared(kSigmas * noise.range)),
      m_bearingVariance(squared(kSigmas * noise.bearing)),
      m_x(beams.size() + 2 * kBlock, kNowhere),
      m_y(m_x.size(), kNowhere),
      m_cosine(m_x.size()),
      m_sine(m_x.size()),
      m_free(beams.size()) {
    for (std::size_t i = 0; i < beams.size(); ++i) {
        const TBeam& beam = beams[i];
        m_cosine[i + kBlock] = static_cast<float>(beam.cosine);
        m_sine[i + kBlock] = static_cast<float>(beam.sine);
        m_free[i] = beam.valid() ? 1 : 0;
        if (!beam.valid()) continue;
        m_x[i + kBlock] = static_cast<float>(beam.x);
        m_y[i + kBlock] = static_cast<float>(beam.y);
    }
}

void CFreePoints::take(const Members& members) {
    for (const auto i : members) {
        m_free[i] = 0;
        m_x[i + kBlock] = kNowhere;
    }
}

/// \param first Index of the block's first point in the padded arrays.
inline void CFreePoints::evaluate(const TNarrowFit& fit, std::size_t first, TBlock& block) const {
    const float* const x = m_x.data() + first;
    const float* const y = m_y.data() + first;
    const float* const c = m_cosine.data() + first;
    const float* const s = m_sine.data() + first;
    for (std::size_t k = 0; k < kBlock; ++k) {
        const float d = x[k] * fit.cosine + y[k] * fit.sine - fit.rho;
        const float t = y[k] * fit.cosine - x[k] * fit.sine;
        const float q = c[k] * fit.cosine + s[k] * fit.sine;
        float tolerance = q * q * m_rangeVariance + t * t * m_bearingVariance;
        tolerance = tolerance < m_roughness2 ? m_roughness2 : tolerance;
        tolerance = tolerance > m_inlier2 ? m_inlier2 : tolerance;
        block.offset[k] = d * d / tolerance;
        block.along[k] = t;
        block.facing[k] = q;
    }
}

float CFreePoints::offset(const TFit& fit, std::size_t i) const {
    TBlock block;
    evaluate(TNarrowFit(fit), i + kBlock, block);
    return block.offset[0];
}

template <int STEP, class USE>
void CFreePoints::extend(const TFit& wide, std::uint32_t seed, USE&& use) const {
    const TNarrowFit fit(wide);
    const auto n = static_cast<int>(m_beams.size());
    const auto start = static_cast<int>(seed);
    float last = static_cast<float>(wide.along(m_beams[seed]));
    bool neighbours = true;
    TBlock block;
    for (int i = start + STEP; i >= 0 && i < n;) {
        const int low = STEP > 0 ? i : i - static_cast<int>(kBlock) + 1;
        evaluate(fit, static_cast<std::size_t>(low + static_cast<int>(kBlock)), block);
        for (std::size_t k = 0; k < kBlock && i >= 0 && i < n; ++k, i += STEP) {
            const auto at = static_cast<std::size_t>(i - low);
            const float offset = block.offset[at];
            if (offset <= 1) {
                const float hole = std::abs(block.along[at] - last);
                if (hole > m_gap && (!neighbours || hole > kSlant * m_gap)) return;
                last = block.along[at];
                neighbours = true;
                use(static_cast<std::uint32_t>(i), offset);
                continue;
            }
            neighbours = false;
            // where this beam would have met the line
            const std::size_t padded = static_cast<std::size_t>(i) + kBlock;
            const float facing = block.facing[at];
            const float side = m_sine[padded] * fit.cosine - m_cosine[padded] * fit.sine;
            if (!(facing > kFacing) || std::abs(fit.rho * side - last * facing) > m_gap * facing)
                return;
        }
    }
}

TRun CFreePoints::measure(const TFit& fit, std::uint32_t seed) const {
    TRun run{seed, seed, 0, 0};
    const float own = offset(fit, seed);
    if (own <= 1) {
        ++run.points;
        run.support += 1 - own;
    }
    extend<-1>(fit, seed, [&run](std::uint32_t i, float offset) {
        run.first = i;
        ++run.points;
        run.support += 1 - offset;
    });
    extend<1>(fit, seed, [&run](std::uint32_t i, float offset) {
        run.last = i;
        ++run.points;
        run.support += 1 - offset;
    });
    return run;
}

void CFreePoints::collect(const TFit& fit, std::uint32_t seed, Members& members) const {
    members.clear();
    extend<-1>(fit, seed, [&](std::uint32_t i, float) { members.push_back(i); });
    std::reverse(members.begin(), members.end());
    if (fits(fit, seed)) members.push_back(seed);
    extend<1>(fit, seed, [&](std::uint32_t i, float) { members.push_back(i); });
}

}  // namespace salma::laser
