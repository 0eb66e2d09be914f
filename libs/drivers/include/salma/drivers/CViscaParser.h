// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace salma::drivers {

enum class EViscaReply {
    acknowledge,   //!< The camera has begun a command and holds it in `socket`.
    completion,    //!< The command in `socket` is done (socket 0: one that needs no socket).
    information,   //!< Answer to an inquiry, in `data`.
    error,         //!< `error` says what; `socket` is 0 if the command never got one.
    addressSet,    //!< The chain has been counted: data[0] is one more than there are cameras.
    networkChange  //!< A camera was added or switched on; addresses must be set again.
};

struct TViscaReply {
    EViscaReply kind{EViscaReply::acknowledge};
    int address{0};  //!< Camera, 1 .. 7; 0 for addressSet.
    int socket{0};   //!< 0 .. 15.
    int error{0};    //!< 02 syntax, 03 buffer full, 04 cancelled, 05 no socket, 41 not executable.
    std::vector<std::uint8_t> data;  //!< Between the head of the packet and its FF.
    double began{0};                 //!< `time` of its first byte, as given to push().
};

/// What arrived so far, by its use.
struct TViscaParserCounts {
    std::size_t replies{0};
    std::size_t strayBytes{0};  //!< Outside packets, and of packets that broke off or are none.
    std::size_t badPackets{0};  //!< Broken off, too long, or of a form that no reply has.
};

/** Turns the bytes that come from a chain of VISCA cameras into replies; no I/O.
 *
 * Bytes may come in pieces of any size. Noise between packets and packets that break off are
 * skipped: a byte with its highest bit set begins a packet wherever it stands, so that one lost FF
 * costs one packet and not two. (No reply to the commands of this library holds such a byte
 * inside.) Memory is bounded by one packet of 16 bytes plus the replies. */
class CViscaParser {
 public:
    /** Replies that `bytes` completed, in their order.
     * \param time When the bytes came, by any clock. */
    std::vector<TViscaReply> push(const std::uint8_t* bytes, std::size_t size, double time = 0);

    /// Forgets a packet that has begun, as after opening the port again.
    void reset() { m_size = 0; }

    const TViscaParserCounts& counts() const { return m_counts; }

 private:
    void begin(std::uint8_t byte, double time);
    void append(std::uint8_t byte);
    void finish(std::vector<TViscaReply>& replies);
    void drop();

    std::array<std::uint8_t, 16> m_packet{};
    std::size_t m_size{0};  //!< Bytes in m_packet; 0 outside a packet.
    double m_began{0};
    TViscaParserCounts m_counts;
};

}  // namespace salma::drivers
