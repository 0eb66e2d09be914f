// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace salma::drivers {

/// What a small controller says in one line: a name and numbers.
struct TSentence {
    std::string name;
    std::vector<double> values;  //!< All finite.
    double began{0};             //!< When its first byte came, by push()'s clock [s].
};

struct TSentenceParserCounts {
    std::size_t sentences{0};
    std::size_t badSentences{0};  //!< Of wrong checksum or form, too long, or broken off.
};

/** Turns the bytes that come from a controller into sentences; no I/O.
 *
 * A sentence is framed as in NMEA 0183, which a few lines of code on any controller can write:
 * `$NAME,number,number*HH` and CR LF, where HH are two hexadecimal digits, the exclusive or of all
 * bytes between $ and *. Bytes may come in pieces of any size; what is no sentence is skipped. */
class CSentenceParser {
 public:
    static constexpr std::size_t maxSentence = 82;  //!< Bytes, $ and CR LF included (NMEA 0183).

    /** Sentences that `bytes` completed, in their order.
     * \param time When the last of them came, by any clock [s].
     * \param byteTime How long one byte takes on the line [s]. */
    std::vector<TSentence> push(const std::uint8_t* bytes,
                                std::size_t size,
                                double time = 0,
                                double byteTime = 0);

    const TSentenceParserCounts& counts() const { return m_counts; }

 private:
    bool finish(TSentence& sentence);

    std::string m_text;  //!< From $ on; empty outside a sentence.
    double m_began{0};
    TSentenceParserCounts m_counts;
};

}  // namespace salma::drivers
