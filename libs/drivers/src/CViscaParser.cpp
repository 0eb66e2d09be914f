// SPDX-License-Identifier: BSD-3-Clause
#include <salma/drivers/CViscaParser.h>
#include <salma/drivers/viscaPackets.h>

#include <optional>

namespace salma::drivers {
namespace {

constexpr std::uint8_t end = 0xFF, broadcast = 0x88;

/// Reply of one camera; `body` lies between its header and FF.
std::optional<TViscaReply> cameraReply(int address, const std::uint8_t* body, std::size_t size) {
    if (address == 0 || size == 0) return std::nullopt;
    TViscaReply reply;
    reply.address = address;
    reply.socket = body[0] & 0x0F;
    const int kind = body[0] >> 4;
    if (kind == 4 && size == 1) {
        reply.kind = EViscaReply::acknowledge;
    } else if (kind == 5) {
        reply.kind = size == 1 ? EViscaReply::completion : EViscaReply::information;
        if (size > 1) reply.data.assign(body + 1, body + size);
    } else if (kind == 6 && size == 2) {
        reply.kind = EViscaReply::error;
        reply.error = body[1];
    } else if (body[0] == 0x38 && size == 1) {
        reply.kind = EViscaReply::networkChange;
        reply.socket = 0;
    } else {
        return std::nullopt;
    }
    return reply;
}

/// Meaning of a packet without its FF.
std::optional<TViscaReply> interpret(const std::uint8_t* packet, std::size_t size) {
    if (packet[0] == broadcast) {
        if (size != 3 || packet[1] != 0x30) return std::nullopt;
        TViscaReply reply;
        reply.kind = EViscaReply::addressSet;
        reply.data = {packet[2]};
        return reply;
    }
    if ((packet[0] & 0x0F) != 0) return std::nullopt;  // not to the computer
    return cameraReply((packet[0] >> 4) - 8, packet + 1, size - 1);
}

}  // namespace

std::vector<TViscaReply> CViscaParser::push(const std::uint8_t* bytes,
                                            std::size_t size,
                                            double time) {
    std::vector<TViscaReply> replies;
    for (std::size_t i = 0; i < size; ++i) {
        if (bytes[i] == end)
            finish(replies);
        else if (bytes[i] >= 0x80)
            begin(bytes[i], time);
        else
            append(bytes[i]);
    }
    return replies;
}

void CViscaParser::finish(std::vector<TViscaReply>& replies) {
    if (m_size > 0) {
        if (auto reply = interpret(m_packet.data(), m_size)) {
            reply->began = m_began;
            replies.push_back(std::move(*reply));
            ++m_counts.replies;
            m_size = 0;
            return;
        }
        drop();
    }
    ++m_counts.strayBytes;
}

void CViscaParser::append(std::uint8_t byte) {
    const std::size_t room = m_packet.size() - 1;  // the last is for FF
    if (m_size > 0 && m_size < room) {
        m_packet[m_size++] = byte;
        return;
    }
    if (m_size > 0) drop();
    ++m_counts.strayBytes;
}

void CViscaParser::begin(std::uint8_t byte, double time) {
    if (m_size > 0) drop();
    m_packet[0] = byte;
    m_size = 1;
    m_began = time;
}

void CViscaParser::drop() {
    m_counts.strayBytes += m_size;
    ++m_counts.badPackets;
    m_size = 0;
}

}  // namespace salma::drivers
