// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/comms/CSerialPort.h>
#include <poll.h>
#include <salma/drivers/CSerialLine.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>

#include "CPortLock.h"

namespace salma::drivers {
namespace {

constexpr int writeTimeoutMs = 1000;  // a packet of 16 bytes takes 17 ms at 9600 baud

}  // namespace

class CSerialLine::CPort : public mrpt::comms::CSerialPort {
 public:
    explicit CPort(const std::string& port) : mrpt::comms::CSerialPort(port, false) {}

    int handle() const { return hCOM; }

    /// True if `event` came within the time; false after it. \throw CPortError if the port is gone.
    bool wait(short event, int timeoutMs) const {
        pollfd entry{hCOM, event, 0};
        int ready = 0;
        do {
            ready = ::poll(&entry, 1, timeoutMs);
        } while (ready < 0 && errno == EINTR);
        if (ready < 0 || (ready > 0 && (entry.revents & ~event) != 0)) gone();  // e.g. POLLHUP
        return ready > 0;
    }

    [[noreturn]] void gone() const { throw CPortError(m_serialName + ": the port went away"); }
};

CSerialLine::CSerialLine(const std::string& port, int baud)
    : m_port(absolutePort(port)),
      m_lock(std::make_unique<CPortLock>(m_port)),
      m_serial(std::make_unique<CPort>(m_port)) {
    try {
        m_serial->open();
        m_serial->setConfig(baud);
    } catch (const std::exception&) {  // MRPT's text is a call stack without the system's reason
        throw CPortError(m_port + ": cannot be set to " + std::to_string(baud) + " baud");
    }
    ioctl(m_serial->handle(), TIOCEXCL);  // for programs that do not ask for the lock
}

CSerialLine::~CSerialLine() { ioctl(m_serial->handle(), TIOCNXCL); }

void CSerialLine::write(const std::vector<std::uint8_t>& bytes) {
    for (std::size_t done = 0; done < bytes.size();) {
        if (!m_serial->wait(POLLOUT, writeTimeoutMs))
            throw CPortError(m_port + ": the port takes no bytes");
        const ssize_t n = ::write(m_serial->handle(), bytes.data() + done, bytes.size() - done);
        if (n < 0 && errno != EAGAIN && errno != EINTR) m_serial->gone();
        if (n > 0) done += static_cast<std::size_t>(n);
    }
    tcdrain(m_serial->handle());
}

std::vector<std::uint8_t> CSerialLine::read(double timeout) {
    const double milliseconds = std::ceil(std::max(0.0, timeout) * 1000);
    if (!m_serial->wait(POLLIN, static_cast<int>(std::min(milliseconds, 1e6)))) return {};
    int waiting = 0;
    if (ioctl(m_serial->handle(), FIONREAD, &waiting) < 0) m_serial->gone();
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(std::max(0, waiting)));
    bytes.resize(m_serial->Read(bytes.data(), bytes.size()));
    return bytes;
}

}  // namespace salma::drivers
