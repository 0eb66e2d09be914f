// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <utility>

#include "CPseudoTerminal.h"

namespace salma::test {

/// One direction of a serial line: bytes arrive one after the other, at the line's rate.
class CWire {
 public:
    /// \param now Seconds. \param baud 0: no delay.
    void put(const TBytes& bytes, double now, int baud);
    /// What has arrived by `now`.
    TBytes take(double now);

 private:
    std::deque<std::pair<double, std::uint8_t>> m_bytes;  //!< With their times of arrival.
    double m_free{0};                                     //!< When the last of them has arrived.
};

}  // namespace salma::test
