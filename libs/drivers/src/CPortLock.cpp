// SPDX-License-Identifier: BSD-3-Clause
#include "CPortLock.h"

#include <fcntl.h>
#include <salma/drivers/CSerialLine.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace salma::drivers {
namespace {

/// Why a port could not be opened, from errno.
std::string cause(int error) {
    switch (error) {
        case ENOENT:
        case ENXIO:
        case ENODEV:
            return "no such serial port, or nothing is plugged in";
        case EACCES:
        case EPERM:
            return "no permission; the user must be in the group that owns it (often dialout)";
        case EBUSY:
        case EWOULDBLOCK:
            return "is in use by another program";
        default:
            return std::strerror(error);
    }
}

}  // namespace

std::string absolutePort(const std::string& port) {
    return port.compare(0, 1, "/") == 0 ? port : "/dev/" + port;
}

CPortLock::CPortLock(const std::string& port)
    : m_handle(::open(port.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
    if (m_handle < 0) throw CPortError(port + ": " + cause(errno));
    std::string problem;
    if (isatty(m_handle) == 0)
        problem = "is not a serial port";
    else if (flock(m_handle, LOCK_EX | LOCK_NB) != 0)
        problem = cause(errno);
    if (problem.empty()) return;
    ::close(m_handle);
    throw CPortError(port + ": " + problem);
}

CPortLock::~CPortLock() { ::close(m_handle); }

}  // namespace salma::drivers
