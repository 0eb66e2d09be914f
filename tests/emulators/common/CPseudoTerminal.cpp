// SPDX-License-Identifier: BSD-3-Clause
#include "CPseudoTerminal.h"

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <stdexcept>

namespace salma::test {

CPseudoTerminal::CPseudoTerminal(std::string link) : m_link(std::move(link)) { plug(); }

void CPseudoTerminal::plug() {
    unplug();
    // A real line does not wait for who does not listen either.
    m_device = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
    std::array<char, 128> name{};
    if (m_device < 0 || grantpt(m_device) != 0 || unlockpt(m_device) != 0 ||
        ptsname_r(m_device, name.data(), name.size()) != 0)
        throw std::runtime_error("cannot make a pseudo-terminal");
    m_computer = open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    termios raw{};
    if (m_computer < 0 || tcgetattr(m_computer, &raw) != 0)
        throw std::runtime_error(std::string("cannot open ") + name.data());
    cfmakeraw(&raw);  // no echo of what the device says before a program has set the port
    tcsetattr(m_computer, TCSANOW, &raw);
    const std::string fresh = m_link + ".new";
    std::filesystem::create_symlink(name.data(), fresh);
    std::filesystem::rename(fresh, m_link);
}

void CPseudoTerminal::unplug() {
    if (m_device < 0) return;
    std::error_code ignored;
    std::filesystem::remove(m_link, ignored);
    close(m_device);
    close(m_computer);
    m_device = m_computer = -1;
}

TBytes CPseudoTerminal::read(int timeoutMs) {
    pollfd entry{m_device, POLLIN, 0};
    if (poll(&entry, 1, timeoutMs) <= 0 || m_device < 0) return {};
    TBytes bytes(256);
    const ssize_t n = ::read(m_device, bytes.data(), bytes.size());
    bytes.resize(n > 0 ? static_cast<std::size_t>(n) : 0);
    return bytes;
}

void CPseudoTerminal::write(const TBytes& bytes) {
    if (m_device < 0 || bytes.empty()) return;
    [[maybe_unused]] const ssize_t n = ::write(m_device, bytes.data(), bytes.size());
}

int CPseudoTerminal::baud() const {
    termios settings{};
    if (tcgetattr(m_device, &settings) != 0) return 0;
    switch (cfgetospeed(&settings)) {
        case B9600:
            return 9600;
        case B19200:
            return 19200;
        case B38400:
            return 38400;
        case B115200:
            return 115200;
        case B500000:
            return 500000;
        default:
            return 0;
    }
}

}  // namespace salma::test
