// SPDX-License-Identifier: BSD-3-Clause
#include "CTalker.h"

#include <algorithm>
#include <cstdio>

namespace salma::test {

TBytes CTalker::transmit(double now) {
    if (now < m_next) return {};
    m_next = std::max(m_next + m_period, now);
    std::string text = m_name;
    for (const double value : m_values(now)) {
        char number[32];
        std::snprintf(number, sizeof number, ",%.4f", value);
        text += number;
    }
    unsigned sum = 0;
    for (const char c : text) sum ^= static_cast<unsigned char>(c);
    ++m_sentences;
    if (m_garbled && m_sentences % 2 == 0) sum ^= 1;
    char end[8];
    std::snprintf(end, sizeof end, "*%02X\r\n", sum);
    text = "$" + text + end;
    if (m_garbled && m_sentences % 4 == 1) text.resize(text.size() / 2);
    if (m_silent) return {};
    return {text.begin(), text.end()};
}

}  // namespace salma::test
