// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

/** Packets of the VISCA protocol, as far as a pan/tilt camera needs them.
 *
 * Every packet begins with a byte that has its highest bit set (1, sender, receiver), ends with FF,
 * and holds 16-bit numbers as four bytes of four bits each, the highest first. The computer has
 * address 0, cameras have 1 to 7 in the order of the chain.
 * Source: Sony, "EVI-D30/D31 Command List", Ver. 1.21. */
namespace salma::drivers::visca {

using TPacket = std::vector<std::uint8_t>;

/// Position of a head in the steps of its motors [counts], each in 16 bits with sign.
struct TPanTiltCounts {
    int pan{0};
    int tilt{0};
    bool operator==(const TPanTiltCounts& other) const {
        return pan == other.pan && tilt == other.tilt;
    }
};

/// Speed bytes: pan 1 .. maxPanSpeed, tilt 1 .. maxTiltSpeed.
struct TSpeed {
    int pan{1};
    int tilt{1};
};

constexpr int maxAddress = 7;
constexpr int maxPanSpeed = 0x18;
constexpr int maxTiltSpeed = 0x14;
constexpr std::size_t maxPacket = 16;  //!< Bytes, header and FF included.

/// What an error reply says.
constexpr int syntaxError = 0x02, bufferFull = 0x03, cancelled = 0x04, noSocket = 0x05,
              notExecutable = 0x41;

/// To all cameras: take addresses 1, 2, ... along the chain.
TPacket addressSet();

/// Each throws std::invalid_argument if a number does not fit into its field.
TPacket interfaceClear(int address);
TPacket panTiltAbsolute(int address, const TSpeed& speed, const TPanTiltCounts& target);
TPacket panTiltRelative(int address, const TSpeed& speed, const TPanTiltCounts& step);
TPacket panTiltHome(int address);
TPacket zoomDirect(int address, int counts);
TPacket panTiltInquiry(int address);
TPacket zoomInquiry(int address);
/// Ends the command that the camera works on in `socket`.
TPacket cancel(int address, int socket);

/// Bytes between the header and FF of an answer; nothing if they are not such an answer.
std::optional<TPanTiltCounts> decodePanTilt(const std::vector<std::uint8_t>& data);
std::optional<int> decodeZoom(const std::vector<std::uint8_t>& data);

}  // namespace salma::drivers::visca
