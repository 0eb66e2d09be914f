// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/core/Clock.h>
#include <salma/drivers/CSentenceParser.h>
#include <salma/drivers/CSerialLine.h>

namespace salma::drivers {

/// A serial port at whose other end a controller says sentences.
class CSentenceLine {
 public:
    /// \throw CPortError
    CSentenceLine(const std::string& port, int baud)
        : m_line(port, baud), m_byteTime(10.0 / baud) {}

    /** What has come, or comes first within `timeout` [s]; stamps by mrpt::Clock.
     * \throw CPortError if the port is gone */
    std::vector<TSentence> read(double timeout) {
        const auto bytes = m_line.read(timeout);
        return m_parser.push(bytes.data(), bytes.size(), mrpt::Clock::toDouble(mrpt::Clock::now()),
                             m_byteTime);
    }

 private:
    CSerialLine m_line;
    CSentenceParser m_parser;
    double m_byteTime;
};

}  // namespace salma::drivers
