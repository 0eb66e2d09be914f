// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/simulator/COdometryModel.h>

#include <cmath>

#include "seeds.h"

namespace salma::simulator {

using mrpt::math::TPose2D;

COdometryModel::COdometryModel(const TOdometryOptions& options, std::uint32_t seed)
    : m_options(options),
      m_random(std::make_unique<CRandom>(seed, "wheels", 0)),
      m_slips(std::make_unique<CRandom>(seed, "slips", 0)) {
    m_options.validate();
    CRandom systematic(seed, "wheels systematic", 0);
    m_scale = systematic.normal(m_options.factor() * m_options.scaleSigma);
    m_turnScale = systematic.normal(m_options.factor() * m_options.turnScaleSigma);
    m_drift = systematic.normal(m_options.factor() * m_options.driftSigma);
}

COdometryModel::~COdometryModel() = default;

TPose2D COdometryModel::next(const TPose2D& T_w_r) {
    if (!m_last) {
        m_last = T_w_r;
        return m_pose;
    }
    const double dx = T_w_r.x - m_last->x, dy = T_w_r.y - m_last->y;
    const double c = std::cos(m_last->phi), s = std::sin(m_last->phi);
    const double forward = c * dx + s * dy, sideways = -s * dx + c * dy;
    const double turn = mrpt::math::wrapToPi(T_w_r.phi - m_last->phi);
    const double d = std::hypot(forward, sideways), k = m_options.factor();
    double slip = 0, slipTurn = 0;
    if (m_options.slipsPerMetre > 0 && m_slips->unit() < m_options.slipsPerMetre * d) {
        slip = m_slips->normal(k * m_options.slip);
        slipTurn = m_slips->normal(k * m_options.slipTurn);
    }
    const double seenForward = forward * (1 + m_scale) + slip +
                               m_random->normal(k * m_options.distanceSigma * std::sqrt(d));
    const double seenSideways = sideways * (1 + m_scale);
    const double seenTurn = turn * (1 + m_turnScale) + m_drift * d + slipTurn +
                            m_random->normal(k * m_options.headingSigma * std::sqrt(d)) +
                            m_random->normal(k * m_options.turnSigma * std::sqrt(std::abs(turn)));
    const double co = std::cos(m_pose.phi), so = std::sin(m_pose.phi);
    m_pose = TPose2D(m_pose.x + co * seenForward - so * seenSideways,
                     m_pose.y + so * seenForward + co * seenSideways,
                     mrpt::math::wrapToPi(m_pose.phi + seenTurn));
    m_last = T_w_r;
    return m_pose;
}

}  // namespace salma::simulator
