// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>
#include <vector>

namespace salma::test {

/** Time in the emulated world over the time of the computer's clock.
 *
 * Pictures are rendered beforehand, each for one time of the world, but a program looks at them
 * when it likes. So they set the pace: when picture k is looked at, its time is come; then the
 * world's time runs as the computer's does, until it waits for picture k + 1. All that measures
 * asks this clock, so a program that is late sees a robot that stood still, not a wrong one. */
class CWorldClock {
 public:
    /// \param times Of the pictures, in the world [s], not decreasing.
    explicit CWorldClock(std::vector<double> times) : m_times(std::move(times)) {}

    /// Picture `index` was looked at, at `now`. Pictures before it and itself are ignored again.
    void looked(std::size_t index, double now);

    /// Time in the world [s] at `now`.
    double at(double now) const;

 private:
    std::vector<double> m_times;
    mutable std::mutex m_mutex;
    std::size_t m_next{0};  //!< Picture that is waited for.
    double m_since{0};      //!< When the one before was looked at.
};

}  // namespace salma::test
