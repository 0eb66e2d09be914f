// SPDX-License-Identifier: BSD-3-Clause
#include "CMotor.h"

#include <cmath>

namespace salma::test {

double CMotor::arrival() const { return m_start + std::abs(m_target - m_from) / m_speed; }

double CMotor::at(double now) const {
    if (now >= arrival()) return m_target;
    if (now <= m_start) return m_from;
    return m_from + std::copysign((now - m_start) * m_speed, m_target - m_from);
}

void CMotor::runTo(double target, double speed, double now) {
    m_from = at(now);
    m_target = target;
    m_speed = speed;
    m_start = now;
}

}  // namespace salma::test
