// SPDX-License-Identifier: BSD-3-Clause
#include "CEviD30.h"

#include <algorithm>
#include <cmath>

namespace salma::test {
namespace {

constexpr double panCountsPerDegree = 8.8, tiltCountsPerDegree = 12;
constexpr int panEnd = 0x370, tiltEnd = 0x12C, zoomEnd = 0x3FF;
constexpr double zoomSpeed = 350;  // counts a second

bool is(const TBytes& packet, std::initializer_list<int> body) {
    return packet.size() >= body.size() + 2 &&
           std::equal(body.begin(), body.end(), packet.begin() + 1,
                      [](int wanted, std::uint8_t byte) { return wanted == byte; });
}

int number(const TBytes& packet, std::size_t at) {
    int value = 0;
    for (std::size_t i = at; i < at + 4; ++i) value = value * 16 + (packet[i] & 0x0F);
    return value;
}

int signedNumber(const TBytes& packet, std::size_t at) {
    const int value = number(packet, at);
    return value > 0x7FFF ? value - 0x10000 : value;
}

void append(TBytes& answer, double position) {
    const int value = static_cast<int>(std::lround(position)) & 0xFFFF;
    for (const int shift : {12, 8, 4, 0})
        answer.push_back(static_cast<std::uint8_t>((value >> shift) & 0x0F));
}

std::uint8_t byteOf(int value) { return static_cast<std::uint8_t>(value); }

}  // namespace

void CEviD30::receive(const TBytes& bytes, int baud, double now) {
    if (baud != 9600 || m_asleep) return;
    for (const auto byte : bytes) {
        m_in.push_back(byte);
        if (byte == 0xFF) {
            handle(m_in, now);
            m_in.clear();
        }
    }
}

TBytes CEviD30::transmit(double now) {
    for (std::size_t i = 0; i < m_sockets.size(); ++i) {
        if (!m_sockets[i]) continue;
        const double end =
            m_sockets[i]->head ? std::max(m_pan.arrival(), m_tilt.arrival()) : m_zoom.arrival();
        if (now < end) continue;
        if (!m_sockets[i]->mute) say({0x90, byteOf(0x51 + static_cast<int>(i)), 0xFF});
        m_sockets[i].reset();
    }
    if (now < m_silentUntil) return {};
    TBytes out;
    out.swap(m_out);
    return out;
}

void CEviD30::sleep(bool asleep) {
    m_asleep = asleep;
    m_address = 0;
    m_in.clear();
    m_out.clear();
    m_sockets = {};
}

void CEviD30::restart() {
    sleep(false);
    say({0x90, 0x38, 0xFF});
}

void CEviD30::turnTo(double pan, double tilt, double now) {
    constexpr double atOnce = 1e9;
    m_pan.runTo(pan * panCountsPerDegree, atOnce, now);
    m_tilt.runTo(tilt * tiltCountsPerDegree, atOnce, now);
}

void CEviD30::handle(const TBytes& packet, double now) {
    const bool broadcast = packet[0] == 0x88;
    if (!broadcast && (m_address == 0 || packet[0] != 0x80 + m_address)) return;
    ++m_packets;
    EFault fault = EFault::none;
    if (!m_faults.empty()) {
        fault = m_faults.front();
        m_faults.pop_front();
    }
    if (fault == EFault::deaf) return;
    if (broadcast)
        handleBroadcast(packet);
    else if (fault == EFault::bufferFull)
        say({0x90, 0x60, 0x03, 0xFF});
    else if (fault == EFault::syntaxError)
        say({0x90, 0x60, 0x02, 0xFF});
    else if (fault == EFault::notExecutable)
        say({0x90, 0x60, 0x41, 0xFF});
    else if (packet[1] == 0x09)
        handleInquiry(packet, fault, now);
    else if (packet.size() == 3 && (packet[1] & 0xF0) == 0x20)
        cancel(packet[1] & 0x0F, now);
    else
        handleCommand(packet, fault, now);
}

void CEviD30::handleBroadcast(const TBytes& packet) {
    if (!is(packet, {0x30, 0x01})) return;
    m_address = 1;
    say({0x88, 0x30, 0x02, 0xFF});
}

void CEviD30::handleInquiry(const TBytes& packet, EFault fault, double now) {
    ++m_inquiries;
    TBytes answer{0x90, 0x50};
    if (is(packet, {0x09, 0x06, 0x12})) {
        append(answer, m_pan.at(now));
        append(answer, m_tilt.at(now));
    } else if (is(packet, {0x09, 0x04, 0x47})) {
        append(answer, m_zoom.at(now));
    } else {
        return say({0x90, 0x60, 0x02, 0xFF});
    }
    answer.push_back(0xFF);
    if (fault == EFault::lateAnswer) m_silentUntil = now + 0.4;
    say(answer, fault);
}

void CEviD30::handleCommand(const TBytes& packet, EFault fault, double now) {
    if (is(packet, {0x01, 0x00, 0x01})) {  // IF_Clear
        for (CMotor* motor : {&m_pan, &m_tilt, &m_zoom}) motor->stop(now);
        m_sockets = {};
        return say({0x90, 0x50, 0xFF}, fault);
    }
    const bool head = is(packet, {0x01, 0x06});
    const bool replaces =
        head && ((m_sockets[0] && m_sockets[0]->head) || (m_sockets[1] && m_sockets[1]->head));
    if (m_sockets[0] && m_sockets[1] && !replaces) return say({0x90, 0x60, 0x03, 0xFF});
    if (head && packet.size() == 15) {
        if (!drive(packet, now)) return say({0x90, 0x60, 0x41, 0xFF});
    } else if (is(packet, {0x01, 0x06, 0x04}) && packet.size() == 5) {
        runHead(0, 0, 0x18, 0x14, now);
    } else if (is(packet, {0x01, 0x04, 0x47}) && packet.size() == 9) {
        m_zoom.runTo(std::min(number(packet, 4), zoomEnd), zoomSpeed, now);
    } else {
        return say({0x90, 0x60, 0x02, 0xFF});
    }
    begin(head, fault, now);
}

bool CEviD30::drive(const TBytes& packet, double now) {
    double pan = signedNumber(packet, 6), tilt = signedNumber(packet, 10);
    if (packet[3] == 0x03) {  // relative
        pan += std::round(m_pan.at(now));
        tilt += std::round(m_tilt.at(now));
    } else if (packet[3] != 0x02) {
        return false;
    }
    const int panSpeed = packet[4], tiltSpeed = packet[5];
    if (std::abs(pan) > panEnd || std::abs(tilt) > tiltEnd || panSpeed < 1 || panSpeed > 0x18 ||
        tiltSpeed < 1 || tiltSpeed > 0x14)
        return false;
    runHead(pan, tilt, panSpeed, tiltSpeed, now);
    return true;
}

void CEviD30::runHead(double pan, double tilt, int panSpeed, int tiltSpeed, double now) {
    m_pan.runTo(pan, panSpeed * 80.0 / 0x18 * panCountsPerDegree, now);
    m_tilt.runTo(tilt, tiltSpeed * 50.0 / 0x14 * tiltCountsPerDegree, now);
}

void CEviD30::begin(bool head, EFault fault, double now) {
    ++m_motions;
    for (std::size_t i = 0; i < m_sockets.size() && head; ++i) {
        if (!m_sockets[i] || !m_sockets[i]->head) continue;
        say({0x90, byteOf(0x61 + static_cast<int>(i)), 0x04, 0xFF});
        m_sockets[i].reset();
    }
    const std::size_t i = m_sockets[0] ? 1 : 0;
    m_sockets[i] = TJob{head, fault == EFault::noCompletion || fault == EFault::jam};
    if (fault == EFault::jam) {
        m_pan.runTo(m_pan.at(m_pan.arrival()) / 2, 500, now);
        m_tilt.runTo(m_tilt.at(m_tilt.arrival()) / 2, 500, now);
    }
    if (fault != EFault::noAck) say({0x90, byteOf(0x41 + static_cast<int>(i)), 0xFF}, fault);
}

void CEviD30::cancel(int socket, double now) {
    const auto i = static_cast<std::size_t>(socket - 1);
    const auto code = byteOf(0x60 + socket);
    if (i >= m_sockets.size() || !m_sockets[i]) return say({0x90, code, 0x05, 0xFF});
    if (m_sockets[i]->head) {
        m_pan.stop(now);
        m_tilt.stop(now);
    } else {
        m_zoom.stop(now);
    }
    m_sockets[i].reset();
    say({0x90, code, 0x04, 0xFF});
}

void CEviD30::say(TBytes answer, EFault fault) {
    if (fault == EFault::cutAnswer) answer.resize(answer.size() / 2);
    if (fault == EFault::garbage)
        for (int i = 0; i < 20; ++i) m_out.push_back(byteOf(static_cast<int>(m_random() % 256)));
    m_out.insert(m_out.end(), answer.begin(), answer.end());
}

}  // namespace salma::test
