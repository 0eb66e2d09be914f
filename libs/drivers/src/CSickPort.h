// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/comms/CSerialPort.h>
#include <salma/drivers/CSickParser.h>

#include <deque>
#include <memory>
#include <string>

#include "CPortLock.h"

namespace salma::drivers {

/** The serial port that MRPT's CSickLaserSerial reads from: it hands out whole and right replies
 * only.
 *
 * CSickLaserSerial (2.5.8) writes beyond its buffer where a corrupted length says so, waits XX None
 * of that can happen behind a parser. A port that goes away is remembered instead of thrown about.
 */
class CSickPort : public mrpt::comms::CSerialPort {
 public:
    /// \throw CPortError if the port cannot be had. Does not open it: CSickLaserSerial does.
    explicit CSickPort(const std::string& port);
    ~CSickPort() override;

    /// Hands out what has come, or waits for it a tenth of a second. Never throws.
    std::size_t Read(void* buffer, std::size_t count) override;
    /// A new command: what the laser said before is of no use any more. Never throws.
    std::size_t Write(const void* buffer, std::size_t count) override;

    /// For other programs the port is in use, even if they do not ask for the lock.
    void claim() const;

    /// True if a whole reply is waiting that has not been handed out.
    bool waiting() const { return !m_replies.empty(); }
    /// When the first byte of the reply came that was handed out last [s, mrpt::Clock].
    double began() const { return m_began; }
    /// Why the port can be used no longer; "" while it can.
    const std::string& problem() const { return m_problem; }
    const TSickParserCounts& counts() const { return m_parser.counts(); }

 private:
    bool wait(short event, int timeoutMs);
    void receive();
    bool wanted(const TSickReply& reply);
    void gone();

    CPortLock m_lock;
    CSickParser m_parser;
    std::deque<TSickReply> m_replies;
    std::size_t m_handedOut{0};      //!< Bytes of the first of m_replies.
    bool m_awaitsAcknowledge{true};  //!< Since the last command.
    int m_answer{0};                 //!< First byte of the telegram that answers it; 0: it came.
    double m_began{0};
    std::string m_problem;
};

}  // namespace salma::drivers
