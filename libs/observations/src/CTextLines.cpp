// SPDX-License-Identifier: BSD-3-Clause
#include "CTextLines.h"

#include <array>
#include <boost/iostreams/device/file.hpp>
#include <boost/iostreams/filter/bzip2.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace fs = std::filesystem;
namespace io = boost::iostreams;

namespace salma::observations {
namespace {

constexpr std::size_t kMaxLine = 1U << 16;  // a scan of 361 readings has 3 kB

std::string firstBytes(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    std::array<char, 3> bytes{};
    stream.read(bytes.data(), bytes.size());
    if (stream.bad() || !stream.is_open()) throw std::runtime_error(file + ": cannot be read");
    return {bytes.data(), static_cast<std::size_t>(stream.gcount())};
}

}  // namespace

CTextLines::CTextLines(const std::string& file) : m_file(file), m_buffer(kMaxLine) {
    std::error_code error;
    if (!fs::exists(file, error)) throw std::runtime_error(file + ": no such file");
    if (fs::is_directory(file, error)) throw std::runtime_error(file + ": is a folder, not a file");
    const std::string head = firstBytes(file);
    if (head.empty()) throw std::runtime_error(file + ": is empty");
    if (head.compare(0, 2, "\x1f\x8b") == 0) m_stream.push(io::gzip_decompressor());
    if (head == "BZh") m_stream.push(io::bzip2_decompressor());
    m_stream.push(io::file_source(file, std::ios::binary));
    m_stream.exceptions(std::ios::badbit);  // a damaged packing throws instead of ending the text
}

void CTextLines::fail(const std::string& what) const {
    throw std::runtime_error(m_file + ": line " + std::to_string(m_number) + ": " + what);
}

bool CTextLines::next(std::string_view& line) {
    ++m_number;
    try {
        m_stream.getline(m_buffer.data(), static_cast<std::streamsize>(m_buffer.size()));
    } catch (const std::ios::failure&) {
        fail("the packed file is damaged or breaks off here");
    }
    const auto count = static_cast<std::size_t>(m_stream.gcount());
    if (m_stream.eof()) {
        if (count > 0) fail("breaks off: the file's last line has no end");
        return false;
    }
    if (m_stream.fail()) fail("is longer than " + std::to_string(kMaxLine) + " characters");
    line = std::string_view(m_buffer.data(), count - 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return true;
}

}  // namespace salma::observations
