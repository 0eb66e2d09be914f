// SPDX-License-Identifier: BSD-3-Clause
#include <salma/drivers/viscaPackets.h>

#include <stdexcept>
#include <string>

namespace salma::drivers::visca {
namespace {

constexpr std::uint8_t command = 0x01, inquiry = 0x09;  // second byte
constexpr std::uint8_t lens = 0x04, panTilter = 0x06;   // third byte
constexpr std::uint8_t absolute = 0x02, relative = 0x03, home = 0x04, position = 0x12;
constexpr std::uint8_t zoomPosition = 0x47;
constexpr std::uint8_t end = 0xFF;

int checked(int value, int min, int max, const char* what) {
    if (value < min || value > max)
        throw std::invalid_argument(std::string("VISCA: ") + what + " " + std::to_string(value) +
                                    " is outside [" + std::to_string(min) + ", " +
                                    std::to_string(max) + "]");
    return value;
}

std::uint8_t header(int address) {
    return static_cast<std::uint8_t>(0x80 + checked(address, 1, maxAddress, "address"));
}

/// Four bytes with four bits each; negative numbers in two's complement.
void append16(TPacket& packet, int value) {
    for (int shift = 12; shift >= 0; shift -= 4)
        packet.push_back(static_cast<std::uint8_t>((static_cast<unsigned>(value) >> shift) & 0xFU));
}

std::optional<int> read16(const std::vector<std::uint8_t>& data, std::size_t at) {
    int value = 0;
    for (std::size_t i = at; i < at + 4; ++i) {
        if (data[i] > 0xF) return std::nullopt;
        value = value * 16 + data[i];
    }
    return value;
}

int withSign(int value) { return value < 0x8000 ? value : value - 0x10000; }

TPacket drive(int address, std::uint8_t how, const TSpeed& speed, const TPanTiltCounts& counts) {
    TPacket packet{header(address), command, panTilter, how};
    packet.push_back(static_cast<std::uint8_t>(checked(speed.pan, 1, maxPanSpeed, "pan speed")));
    packet.push_back(static_cast<std::uint8_t>(checked(speed.tilt, 1, maxTiltSpeed, "tilt speed")));
    append16(packet, checked(counts.pan, -0x8000, 0x7FFF, "pan"));
    append16(packet, checked(counts.tilt, -0x8000, 0x7FFF, "tilt"));
    packet.push_back(end);
    return packet;
}

}  // namespace

TPacket addressSet() { return {0x88, 0x30, 0x01, end}; }

TPacket interfaceClear(int address) { return {header(address), command, 0x00, 0x01, end}; }

TPacket panTiltAbsolute(int address, const TSpeed& speed, const TPanTiltCounts& target) {
    return drive(address, absolute, speed, target);
}

TPacket panTiltRelative(int address, const TSpeed& speed, const TPanTiltCounts& step) {
    return drive(address, relative, speed, step);
}

TPacket panTiltHome(int address) { return {header(address), command, panTilter, home, end}; }

TPacket zoomDirect(int address, int counts) {
    TPacket packet{header(address), command, lens, zoomPosition};
    append16(packet, checked(counts, 0, 0xFFFF, "zoom"));
    packet.push_back(end);
    return packet;
}

TPacket panTiltInquiry(int address) { return {header(address), inquiry, panTilter, position, end}; }

TPacket zoomInquiry(int address) { return {header(address), inquiry, lens, zoomPosition, end}; }

TPacket cancel(int address, int socket) {
    return {header(address), static_cast<std::uint8_t>(0x20 + checked(socket, 1, 15, "socket")),
            end};
}

std::optional<TPanTiltCounts> decodePanTilt(const std::vector<std::uint8_t>& data) {
    if (data.size() != 8) return std::nullopt;
    const auto pan = read16(data, 0);
    const auto tilt = read16(data, 4);
    if (!pan || !tilt) return std::nullopt;
    return TPanTiltCounts{withSign(*pan), withSign(*tilt)};
}

std::optional<int> decodeZoom(const std::vector<std::uint8_t>& data) {
    if (data.size() != 4) return std::nullopt;
    return read16(data, 0);
}

}  // namespace salma::drivers::visca
