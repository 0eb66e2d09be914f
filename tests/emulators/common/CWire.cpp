// SPDX-License-Identifier: BSD-3-Clause
#include "CWire.h"

#include <algorithm>

namespace salma::test {

void CWire::put(const TBytes& bytes, double now, int baud) {
    constexpr double bitsPerByte = 10;  // with start and stop bit
    for (const auto byte : bytes) {
        m_free = std::max(m_free, now) + (baud > 0 ? bitsPerByte / baud : 0);
        m_bytes.push_back({m_free, baud, byte});
    }
}

TBytes CWire::take(double now, int baud) {
    TBytes arrived;
    for (; !m_bytes.empty() && m_bytes.front().arrival <= now; m_bytes.pop_front()) {
        const TByte& byte = m_bytes.front();
        const bool understood = baud == 0 || byte.baud == 0 || byte.baud == baud;
        arrived.push_back(understood ? byte.value : static_cast<std::uint8_t>(m_noise() & 0xFF));
    }
    return arrived;
}

}  // namespace salma::test
