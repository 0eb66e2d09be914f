// SPDX-License-Identifier: BSD-3-Clause
#include "CWire.h"

#include <algorithm>

namespace salma::test {

void CWire::put(const TBytes& bytes, double now, int baud) {
    constexpr double bitsPerByte = 10;  // with start and stop bit
    for (const auto byte : bytes) {
        m_free = std::max(m_free, now) + (baud > 0 ? bitsPerByte / baud : 0);
        m_bytes.emplace_back(m_free, byte);
    }
}

TBytes CWire::take(double now) {
    TBytes arrived;
    for (; !m_bytes.empty() && m_bytes.front().first <= now; m_bytes.pop_front())
        arrived.push_back(m_bytes.front().second);
    return arrived;
}

}  // namespace salma::test
