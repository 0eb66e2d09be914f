// SPDX-License-Identifier: BSD-3-Clause
#include "CSickPort.h"

#include <mrpt/core/Clock.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>

namespace salma::drivers {
namespace {

constexpr int readTimeoutMs = 100;    // the LMS 200 acknowledges within 60 ms
constexpr int writeTimeoutMs = 1000;  // the longest command takes 43 ms at 9600 baud
constexpr double bitsPerByte = 10;    // with start and stop bit

}  // namespace

CSickPort::CSickPort(const std::string& port)
    : mrpt::comms::CSerialPort(port, false), m_lock(port) {}

CSickPort::~CSickPort() {
    if (isOpen()) ioctl(hCOM, TIOCNXCL);
}

void CSickPort::claim() const { ioctl(hCOM, TIOCEXCL); }

void CSickPort::gone() { m_problem = m_serialName + ": the port went away"; }

/// True if `event` came within the time; false after it, or if the port is gone.
bool CSickPort::wait(short event, int timeoutMs) {
    pollfd entry{hCOM, event, 0};
    int ready = 0;
    do {
        ready = ::poll(&entry, 1, timeoutMs);
    } while (ready < 0 && errno == EINTR);
    if (ready < 0 || (ready > 0 && (entry.revents & ~event) != 0)) gone();  // e.g. POLLHUP
    return ready > 0 && m_problem.empty();
}

std::size_t CSickPort::Read(void* buffer, std::size_t count) {
    if (m_replies.empty() && m_problem.empty() && wait(POLLIN, readTimeoutMs)) receive();
    if (m_replies.empty() || count == 0) return 0;
    const TSickReply& reply = m_replies.front();
    const std::size_t n = std::min(count, reply.bytes.size() - m_handedOut);
    std::copy_n(reply.bytes.begin() + static_cast<std::ptrdiff_t>(m_handedOut), n,
                static_cast<std::uint8_t*>(buffer));
    m_handedOut += n;
    m_began = reply.began;
    if (m_handedOut == reply.bytes.size()) {
        m_replies.pop_front();
        m_handedOut = 0;
    }
    return n;
}

void CSickPort::receive() {
    std::array<std::uint8_t, 4096> bytes{};
    const ssize_t n = ::read(hCOM, bytes.data(), bytes.size());
    const double now = mrpt::Clock::toDouble(mrpt::Clock::now());
    if (n <= 0) {
        if (n == 0 || (errno != EAGAIN && errno != EINTR)) gone();
        return;
    }
    const double byteTime = m_baudRate > 0 ? bitsPerByte / m_baudRate : 0;
    for (auto& reply : m_parser.push(bytes.data(), static_cast<std::size_t>(n), now, byteTime))
        if (wanted(reply)) m_replies.push_back(std::move(reply));
}

/// A command has an acknowledgement and then its answer; scans may come between.
bool CSickPort::wanted(const TSickReply& reply) {
    const bool telegram = reply.kind == ESickReply::telegram;
    if (telegram == m_awaitsAcknowledge) return false;
    m_awaitsAcknowledge = false;
    if (!telegram || m_answer == 0) return true;
    if (reply.command() != m_answer) return false;
    m_answer = 0;
    return true;
}

std::size_t CSickPort::Write(const void* buffer, std::size_t count) {
    m_replies.clear();
    m_handedOut = 0;
    m_parser.reset();
    m_awaitsAcknowledge = true;
    const auto* bytes = static_cast<const std::uint8_t*>(buffer);
    m_answer = count > 4 ? bytes[4] | 0x80 : 0;  // behind STX, address and length
    std::size_t done = 0;
    while (done < count && m_problem.empty()) {
        if (!wait(POLLOUT, writeTimeoutMs)) {
            if (m_problem.empty()) m_problem = m_serialName + ": the port takes no bytes";
            break;
        }
        const ssize_t n = ::write(hCOM, bytes + done, count - done);
        if (n > 0) done += static_cast<std::size_t>(n);
        if (n < 0 && errno != EAGAIN && errno != EINTR) gone();
    }
    return done;
}

}  // namespace salma::drivers
