// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace salma::drivers {

/// Absolute path of a serial port that may be named by its name below /dev.
std::string absolutePort(const std::string& port);

/// Holds a serial port for this program: a lock that picocom and others ask for as well.
class CPortLock {
 public:
    /// \throw CPortError naming the port if it is not there, is no serial port, or is in use.
    explicit CPortLock(const std::string& port);
    ~CPortLock();
    CPortLock(const CPortLock&) = delete;
    CPortLock& operator=(const CPortLock&) = delete;

 private:
    int m_handle;
};

}  // namespace salma::drivers
