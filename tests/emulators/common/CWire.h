// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <random>

#include "CPseudoTerminal.h"

namespace salma::test {

/** One direction of a serial line: bytes arrive one after the other, at the line's rate.
 *
 * A byte that is listened to at another rate than it was sent with is noise. */
class CWire {
 public:
    /// \param now Seconds. \param baud Of the sender; 0: no delay, and understood at any rate.
    void put(const TBytes& bytes, double now, int baud);
    /// What has arrived by `now`. \param baud Of the listener; 0: any.
    TBytes take(double now, int baud = 0);

 private:
    struct TByte {
        double arrival;
        int baud;
        std::uint8_t value;
    };
    std::deque<TByte> m_bytes;
    double m_free{0};  //!< When the last of them has arrived.
    std::mt19937 m_noise{1};
};

}  // namespace salma::test
