// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace salma::test {

/// One axis that runs to its target at constant speed. Positions in counts, times in seconds.
class CMotor {
 public:
    double at(double now) const;
    /// From where it stands at `now`; \param speed In counts a second.
    void runTo(double target, double speed, double now);
    void stop(double now) { runTo(at(now), 1, now); }
    /// When it will stand.
    double arrival() const;
    double speed() const { return m_speed; }

 private:
    double m_from{0}, m_target{0}, m_speed{1}, m_start{0};
};

}  // namespace salma::test
