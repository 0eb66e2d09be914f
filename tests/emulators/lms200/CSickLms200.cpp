// SPDX-License-Identifier: BSD-3-Clause
#include "CSickLms200.h"

#include <algorithm>
#include <cmath>

namespace salma::test {
namespace {

constexpr std::uint8_t stx = 0x02, ack = 0x06, nak = 0x15, good = 0x10;

std::uint8_t low(std::size_t value) { return static_cast<std::uint8_t>(value & 0xFF); }
std::uint8_t high(std::size_t value) { return static_cast<std::uint8_t>((value >> 8) & 0xFF); }

/// The checksum as SICK's manual lists it: a shift register over pairs of bytes.
std::uint16_t checksum(const TBytes& bytes, std::size_t size) {
    std::uint16_t crc = 0;
    std::uint8_t before = 0;
    for (std::size_t i = 0; i < size; ++i) {
        const bool carry = (crc & 0x8000) != 0;
        crc = static_cast<std::uint16_t>((crc & 0x7FFF) << 1);
        if (carry) crc ^= 0x8005;
        crc ^= static_cast<std::uint16_t>(bytes[i] | (before << 8));
        before = bytes[i];
    }
    return crc;
}

TBytes text(std::uint8_t command, const std::string& words, std::size_t length) {
    TBytes content(length + 1, ' ');
    content[0] = command;
    std::copy_n(words.begin(), std::min(words.size(), length), content.begin() + 1);
    return content;
}

}  // namespace

void CSickLms200::receive(const TBytes& bytes, int baud, double now) {
    if (baud != m_baud || m_asleep) return;
    m_in.insert(m_in.end(), bytes.begin(), bytes.end());
    while (takeTelegram(now)) {
    }
}

/// Handles the telegram that stands first, or skips what is none; false if more bytes are needed.
bool CSickLms200::takeTelegram(double now) {
    m_in.erase(m_in.begin(), std::find(m_in.begin(), m_in.end(), stx));
    if (m_in.size() < 4) return false;
    const std::size_t length = m_in[2] + 256U * m_in[3], size = length + 6;
    const bool possible = m_in[1] == 0 && length > 0 && length < 200;
    if (possible && m_in.size() < size) return false;
    if (possible && m_in[size - 2] + 256 * m_in[size - 1] == checksum(m_in, size - 2)) {
        const auto begin = m_in.begin(), end = begin + static_cast<std::ptrdiff_t>(size);
        const TBytes content(begin + 4, end - 2);
        m_in.erase(begin, end);
        handle(content, now);
    } else {
        m_in.erase(m_in.begin());
    }
    return true;
}

TBytes CSickLms200::transmit(double now) {
    if (m_streaming && now >= m_nextScan && now >= m_lineFree && m_out.empty()) {
        ELmsFault fault = ELmsFault::none;
        if (!m_scanFaults.empty()) {
            fault = m_scanFaults.front();
            m_scanFaults.pop_front();
        }
        send(scanContent(now), fault);
        ++m_scans;
        const double period = m_view.period();
        m_nextScan = std::max(m_nextScan + period, now - period);  // a late one delays no other
    }
    TBytes out;
    out.swap(m_out);
    if (!out.empty())
        m_lineFree = std::max(m_lineFree, now) + 10.0 * static_cast<double>(out.size()) / m_baud;
    m_baud = m_nextBaud;
    if (m_restarts) restart();
    if (m_silent || m_asleep) return {};
    return out;
}

void CSickLms200::sleep(bool asleep) {
    m_asleep = asleep;
    restart();
    if (asleep) m_out.clear();
}

void CSickLms200::restart() {
    m_streaming = m_installing = m_restarts = false;
    m_baud = m_nextBaud = 9600;
    m_in.clear();
    m_out.clear();
    send(text(0x90, "LMS200;30106;V02.30", 20), ELmsFault::none);
}

void CSickLms200::handle(const TBytes& content, double now) {
    ++m_commands;
    ELmsFault fault = ELmsFault::none;
    if (!m_faults.empty()) {
        fault = m_faults.front();
        m_faults.pop_front();
    }
    if (fault == ELmsFault::deaf) return;
    const int command = content[0];
    const bool known = command == 0x10 || command == 0x20 || (command >= 0x30 && command <= 0x32) ||
                       command == 0x3A || command == 0x3B || command == 0x42 || command == 0x74 ||
                       command == 0x77;
    if (!known || fault == ELmsFault::refusal) return m_out.push_back(nak);
    if (fault != ELmsFault::noAcknowledge) m_out.push_back(ack);
    switch (command) {
        case 0x10:
            m_restarts = true;
            return answer({0x91}, fault);
        case 0x20:
            return changeMode(content, fault, now);
        case 0x30:
            return send(scanContent(now), fault);
        case 0x31:
            return answer(text(0xB1, "V02.30", 152), fault);
        case 0x32:
            return answer({0xB2, 0x01, 0x00}, fault);  // one entry: no error
        case 0x3A:
            return answer(text(0xBA, "LMS200;30106;V02.30", 20), fault);
        case 0x3B: {
            const bool right = content.size() == 5 && !m_viewHeld &&
                               (content[1] == 100 || content[1] == 180) &&
                               (content[3] == 25 || content[3] == 50 || content[3] == 100) &&
                               !(content[1] == 180 && content[3] == 25);
            if (right) m_view = {content[1], content[3]};
            return answer({0xBB, static_cast<std::uint8_t>(right ? 1 : 0),
                           low(static_cast<std::size_t>(m_view.aperture)), 0,
                           low(static_cast<std::size_t>(m_view.resolution)), 0},
                          fault);
        }
        case 0x42: {
            const bool right = m_installing && content.size() == 10;
            if (right) m_password.assign(content.begin() + 2, content.end());
            return answer({0xC2, static_cast<std::uint8_t>(right ? 1 : 0)}, fault);
        }
        case 0x74: {
            TBytes config{0xF4};
            config.insert(config.end(), m_config.begin(), m_config.end());
            return answer(config, fault);
        }
        default: {  // 0x77
            const bool right = m_installing && content.size() == m_config.size() + 1;
            if (right) std::copy(content.begin() + 1, content.end(), m_config.begin());
            TBytes config{0xF7, static_cast<std::uint8_t>(right ? 1 : 0)};
            config.insert(config.end(), m_config.begin(), m_config.end());
            return answer(config, fault);
        }
    }
}

bool CSickLms200::passwordIn(const TBytes& content) const {
    return content.size() == 2 + m_password.size() &&
           std::equal(m_password.begin(), m_password.end(), content.begin() + 2);
}

void CSickLms200::changeMode(const TBytes& content, ELmsFault fault, double now) {
    const int mode = content.size() > 1 ? content[1] : -1;
    std::uint8_t result = 0;
    switch (mode) {
        case 0x00:
            result = passwordIn(content) ? 0 : 1;
            if (result == 0) m_installing = true;
            if (result == 0) m_streaming = false;
            break;
        case 0x24:
        case 0x25:
            m_installing = false;
            m_streaming = mode == 0x24;
            m_nextScan = now;
            break;
        case 0x40:
            m_nextBaud = 38400;
            break;
        case 0x41:
            m_nextBaud = 19200;
            break;
        case 0x42:
            m_nextBaud = 9600;
            break;
        case 0x48:
            m_nextBaud = 500000;
            break;
        default:
            result = 2;
    }
    answer({0xA0, result}, fault);
}

TBytes CSickLms200::scanContent(double now) {
    const bool mm = millimetres();
    // Modes 0 .. 2 have 13 bits for a range, 3 and 4 have 14, 5 and 6 have 15.
    const int bits = m_config[modeByte] <= 2 ? 13 : m_config[modeByte] <= 4 ? 14 : 15;
    const auto codes = (std::size_t{1} << bits) - 1;
    const auto ranges = m_scanner(m_view, now);
    const std::size_t n = m_view.beams();
    TBytes content{0xB0, low(n), static_cast<std::uint8_t>(high(n) | (mm ? 0x40 : 0))};
    for (std::size_t i = 0; i < n; ++i) {
        const double steps =
            i < ranges.size() ? std::round(ranges[i] * (mm ? 1000 : 100)) : INFINITY;
        const bool valid = steps >= 0 && steps < static_cast<double>(codes - 8);
        const std::size_t value = valid ? static_cast<std::size_t>(steps) : codes - 8;  // too far
        content.push_back(low(value));
        content.push_back(high(value));
    }
    content.push_back(good);
    return content;
}

void CSickLms200::answer(TBytes content, ELmsFault fault) {
    content.push_back(good);
    send(content, fault);
}

void CSickLms200::send(const TBytes& content, ELmsFault fault) {
    TBytes telegram{stx, 0x80, low(content.size()), high(content.size())};
    telegram.insert(telegram.end(), content.begin(), content.end());
    std::uint16_t crc = checksum(telegram, telegram.size());
    if (fault == ELmsFault::wrongChecksum) ++crc;
    telegram.push_back(low(crc));
    telegram.push_back(high(crc));
    if (fault == ELmsFault::cutTelegram) telegram.resize(telegram.size() / 2);
    if (fault == ELmsFault::noAnswer) telegram.clear();
    if (fault == ELmsFault::absurdLength)
        for (const std::uint8_t byte : {0x02, 0x80, 0xFF, 0xFF}) m_out.push_back(byte);
    if (fault == ELmsFault::noise)
        for (int i = 0; i < 20; ++i) m_out.push_back(low(m_random()));
    m_out.insert(m_out.end(), telegram.begin(), telegram.end());
}

}  // namespace salma::test
