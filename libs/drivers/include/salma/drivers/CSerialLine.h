// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace salma::drivers {

/// A serial port is not there, cannot be used, is in use, or went away; what() names it.
class CPortError : public std::runtime_error {
 public:
    using std::runtime_error::runtime_error;
};

class CPortLock;

/** A serial port (8 bits, no parity, one stop bit, no flow control) that one program uses alone.
 *
 * MRPT's CSerialPort with what it lacks: errors that name the port and the cause, a lock, waiting
 * without polling, and a write that ends where the other side takes nothing (CSerialPort's goes
 * round for ever). Pseudo-terminals will do. */
class CSerialLine {
 public:
    /** Opens and locks the port, and throws away what was waiting in it.
     * \param port Absolute path, or a name below /dev.
     * \param baud A rate that the system knows, e.g. 9600.
     * \throw CPortError */
    CSerialLine(const std::string& port, int baud);
    ~CSerialLine();
    CSerialLine(const CSerialLine&) = delete;
    CSerialLine& operator=(const CSerialLine&) = delete;

    /// Returns when the last byte has left. \throw CPortError if the port is gone or takes nothing.
    void write(const std::vector<std::uint8_t>& bytes);

    /** Bytes that are there, or the first that come within `timeout` [s]; empty if none did.
     * \throw CPortError if the port is gone. */
    std::vector<std::uint8_t> read(double timeout);

    const std::string& port() const { return m_port; }

 private:
    class CPort;

    std::string m_port;  //!< Absolute path.
    std::unique_ptr<CPortLock> m_lock;
    std::unique_ptr<CPort> m_serial;
};

}  // namespace salma::drivers
