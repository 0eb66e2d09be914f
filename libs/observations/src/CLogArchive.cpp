// SPDX-License-Identifier: BSD-3-Clause
#include "CLogArchive.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace fs = std::filesystem;

namespace salma::observations {
namespace {

constexpr std::uint8_t kNameFlag = 0x80;  // in the length byte before a class name
constexpr std::size_t kMaxName = 120;     // MRPT's own limit
// Larger reads than twice zlib's buffer bypass it, and end elsewhere before a damaged place.
constexpr unsigned kBuffer = 1U << 17, kCarefulBuffer = 1U << 13;
constexpr std::size_t kPart = 1U << 16, kCarefulPart = 1U << 12;

bool isClassName(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](unsigned char c) {
        return std::isalnum(c) || c == '_' || c == ':' || c == '<' || c == '>' || c == ',';
    });
}

}  // namespace

CLogArchive::CLogArchive(const std::string& file, bool acceptDamage)
    : m_file(file), m_acceptDamage(acceptDamage) {
    std::error_code error;
    if (!fs::exists(file, error)) throw std::runtime_error(file + ": no such file");
    if (fs::is_directory(file, error)) throw std::runtime_error(file + ": is a folder, not a file");
    inspect();
    if (m_size == 0 && !m_truncated) throw std::runtime_error(file + ": is empty");
    m_stream = open();
}

CLogArchive::TGzip CLogArchive::open() const {
    TGzip stream(gzopen(m_file.c_str(), "rb"));
    if (!stream) throw std::runtime_error(m_file + ": cannot be read: " + std::strerror(errno));
    gzbuffer(stream.get(), m_acceptDamage ? kCarefulBuffer : kBuffer);
    return stream;
}

void CLogArchive::inspect() {
    const TGzip stream = open();
    std::array<char, kPart> buffer{};
    const auto part = static_cast<unsigned>(m_acceptDamage ? kCarefulPart : kPart);
    for (int n = 0; (n = gzread(stream.get(), buffer.data(), part)) > 0;) {
        if (m_size == 0) m_head.assign(buffer.data(), std::min<std::size_t>(n, kMaxName + 1));
        m_size += static_cast<std::uint64_t>(n);
    }
    int code = Z_OK;
    const std::string problem = gzerror(stream.get(), &code);
    m_truncated = code == Z_BUF_ERROR;
    if (code == Z_DATA_ERROR && m_acceptDamage) {
        m_damage = problem.substr(problem.rfind(": ") + 2);  // behind the file's name
        return countUpToDamage();
    }
    if (code != Z_OK && code != Z_BUF_ERROR)
        throw std::runtime_error(
            m_file + ": is damaged after " + std::to_string(m_size) +
            " unpacked bytes: " + (code == Z_ERRNO ? std::strerror(errno) : problem));
}

void CLogArchive::countUpToDamage() {
    const TGzip stream = open();
    std::array<char, kCarefulPart> buffer{};
    for (std::uint64_t done = 0; done < m_size;) {
        const auto part = std::min<std::uint64_t>(m_size - done, buffer.size());
        const int n = gzread(stream.get(), buffer.data(), static_cast<unsigned>(part));
        if (n <= 0) throw std::runtime_error(m_file + ": changed while it was read");
        done += static_cast<std::uint64_t>(n);
    }
    while (gzread(stream.get(), buffer.data(), 1) == 1) {
        if (m_head.size() <= kMaxName) m_head += buffer[0];
        ++m_size;
    }
    m_packedBytesLost = fs::file_size(m_file) - static_cast<std::uint64_t>(gzoffset(stream.get()));
}

bool CLogArchive::beginsAsRawlog() const {
    if (m_head.empty()) return m_truncated;  // broken off before the first byte of content
    const auto first = static_cast<std::uint8_t>(m_head[0]);
    const std::size_t length = first & ~kNameFlag;
    std::size_t start = 1;
    if (!(first & kNameFlag)) {  // before MRPT 0.5.5: the length has four bytes
        for (start = 1; start < 4 && start < m_head.size(); ++start)
            if (m_head[start] != '\0') return false;
    }
    return length > 0 && length <= kMaxName &&
           isClassName(std::string_view(m_head).substr(std::min(start, m_head.size()), length));
}

std::size_t CLogArchive::read(void* data, std::size_t bytes) {
    const std::uint64_t at = m_position;
    readBytes(data, bytes);
    notice(at, static_cast<const std::uint8_t*>(data), bytes);
    return bytes;
}

void CLogArchive::readBytes(void* data, std::size_t bytes) {
    if (bytes > m_size - m_position) {
        m_brokeOff = true;
        throw std::runtime_error("the file breaks off");
    }
    auto* target = static_cast<std::uint8_t*>(data);
    for (std::size_t done = 0; done < bytes;) {
        const std::size_t part = std::min(bytes - done, m_acceptDamage ? kCarefulPart : 1U << 30);
        const int n = gzread(m_stream.get(), target + done, static_cast<unsigned>(part));
        if (n <= 0) throw std::runtime_error("the file changed while it was read");
        done += static_cast<std::size_t>(n);
    }
    m_position += bytes;
}

std::size_t CLogArchive::write(const void*, std::size_t) {
    throw std::logic_error("a log that is read cannot be written");
}

void CLogArchive::notice(std::uint64_t at, const std::uint8_t* data, std::size_t bytes) {
    const std::string_view text(reinterpret_cast<const char*>(data), bytes);
    m_refusal = m_guard.check(at, text, m_size);
    if (!m_refusal.empty()) throw std::runtime_error(m_refusal);
    if (m_versionFollows && bytes == 1) {
        m_guard.begin(m_lastClass, data[0], at + 1);
        m_versionFollows = false;
        return;
    }
    m_versionFollows = m_nameLength > 0 && bytes == m_nameLength && isClassName(text);
    if (m_versionFollows) m_lastClass = text;
    m_nameLength = bytes == 1 && (data[0] & kNameFlag) ? data[0] & ~kNameFlag : 0;
}

}  // namespace salma::observations
