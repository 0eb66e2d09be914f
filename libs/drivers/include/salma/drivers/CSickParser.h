// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace salma::drivers {

enum class ESickReply {
    telegram,     //!< Whole, from the laser, with the right checksum.
    acknowledge,  //!< The laser has taken a command.
    refusal       //!< The laser does not take a command.
};

struct TSickReply {
    ESickReply kind{ESickReply::acknowledge};
    std::vector<std::uint8_t> bytes;  //!< As on the line; of a telegram from STX to checksum.
    double began{0};                  //!< When its first byte came, by push()'s clock [s].

    /// First byte of a telegram's content, e.g. B0 (hexadecimal) for a scan; 0 for the others.
    int command() const { return kind == ESickReply::telegram ? bytes[4] : 0; }
};

/// What arrived so far, by its use.
struct TSickParserCounts {
    std::size_t replies{0};
    std::size_t strayBytes{0};    //!< Outside replies, and of telegrams that are none.
    std::size_t badTelegrams{0};  //!< Broken off, corrupted or of no possible length.
};

/** Turns the bytes that come from a SICK LMS 2xx into replies; no I/O.
 *
 * A telegram is 02 80, length L (2 bytes, low one first), L bytes of content, checksum (2 bytes).
 * Bytes may come in pieces of any size. What proves to be no telegram is searched again from its
 * second byte, so that one that broke off does not take the next with it. Memory is bounded by one
 * telegram plus the replies. Source: SICK, "Telegrams for configuring and operating the LMS 2xx".
 */
class CSickParser {
 public:
    /// Longest telegram [bytes]: what MRPT's CSickLaserSerial accepts. The longest in use has 732.
    static constexpr std::size_t maxTelegram = 800;

    /** Replies that `bytes` completed, in their order.
     * \param time When the last of them came, by any clock [s].
     * \param byteTime How long one byte takes on the line [s]. */
    std::vector<TSickReply> push(const std::uint8_t* bytes,
                                 std::size_t size,
                                 double time = 0,
                                 double byteTime = 0);

    /// Forgets a telegram that has begun, as after a new command.
    void reset();

    const TSickParserCounts& counts() const { return m_counts; }

 private:
    bool takeOne(std::vector<TSickReply>& replies);
    void take(ESickReply kind, std::size_t size, std::vector<TSickReply>& replies);
    void drop(std::size_t size);

    std::vector<std::uint8_t> m_bytes;
    std::vector<double> m_times;  //!< Of m_bytes [s].
    TSickParserCounts m_counts;
};

/// Checksum of `size` bytes as the LMS 2xx counts it.
std::uint16_t sickChecksum(const std::uint8_t* bytes, std::size_t size);

}  // namespace salma::drivers
