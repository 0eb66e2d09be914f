// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/system/crc.h>
#include <salma/drivers/CSickParser.h>

namespace salma::drivers {
namespace {

constexpr std::uint8_t stx = 0x02, fromLaser = 0x80, ack = 0x06, nak = 0x15;
constexpr std::size_t head = 4, checksum = 2;

}  // namespace

std::uint16_t sickChecksum(const std::uint8_t* bytes, std::size_t size) {
    return mrpt::system::compute_CRC16(bytes, size, 0x8005);
}

std::vector<TSickReply> CSickParser::push(const std::uint8_t* bytes,
                                          std::size_t size,
                                          double time,
                                          double byteTime) {
    std::vector<TSickReply> replies;
    for (std::size_t i = 0; i < size; ++i) {
        m_bytes.push_back(bytes[i]);
        m_times.push_back(time - byteTime * static_cast<double>(size - 1 - i));
        // Only here can the telegram that stands first have become whole: memory stays bounded.
        while (takeOne(replies)) {
        }
    }
    return replies;
}

void CSickParser::reset() {
    m_counts.strayBytes += m_bytes.size();
    m_bytes.clear();
    m_times.clear();
}

/// Deals with what stands first; false if that takes more bytes.
bool CSickParser::takeOne(std::vector<TSickReply>& replies) {
    if (m_bytes.empty()) return false;
    if (m_bytes[0] == ack || m_bytes[0] == nak) {
        take(m_bytes[0] == ack ? ESickReply::acknowledge : ESickReply::refusal, 1, replies);
        return true;
    }
    if (m_bytes[0] != stx) {
        drop(1);
        return true;
    }
    if (m_bytes.size() < 2) return false;
    if (m_bytes[1] != fromLaser) {
        drop(1);
        return true;
    }
    if (m_bytes.size() < head) return false;
    const std::size_t content = m_bytes[2] + 256U * m_bytes[3];
    const std::size_t size = head + content + checksum;
    if (content > 0 && size <= maxTelegram) {
        if (m_bytes.size() < size) return false;
        const unsigned found = m_bytes[size - 2] + 256U * m_bytes[size - 1];
        if (found == sickChecksum(m_bytes.data(), size - checksum)) {
            take(ESickReply::telegram, size, replies);
            return true;
        }
    }
    ++m_counts.badTelegrams;
    drop(1);
    return true;
}

void CSickParser::take(ESickReply kind, std::size_t size, std::vector<TSickReply>& replies) {
    const auto end = m_bytes.begin() + static_cast<std::ptrdiff_t>(size);
    replies.push_back({kind, {m_bytes.begin(), end}, m_times.front()});
    ++m_counts.replies;
    m_bytes.erase(m_bytes.begin(), end);
    m_times.erase(m_times.begin(), m_times.begin() + static_cast<std::ptrdiff_t>(size));
}

void CSickParser::drop(std::size_t size) {
    m_counts.strayBytes += size;
    m_bytes.erase(m_bytes.begin(), m_bytes.begin() + static_cast<std::ptrdiff_t>(size));
    m_times.erase(m_times.begin(), m_times.begin() + static_cast<std::ptrdiff_t>(size));
}

}  // namespace salma::drivers
