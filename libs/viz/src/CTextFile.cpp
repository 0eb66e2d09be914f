// SPDX-License-Identifier: BSD-3-Clause
#include "CTextFile.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace salma::viz {
namespace {

[[noreturn]] void fail(const std::string& file, const std::string& problem) {
    const std::string reason = errno != 0 ? std::string(": ") + std::strerror(errno) : "";
    throw std::runtime_error(file + ": " + problem + reason);
}

std::string written(double value, std::chars_format format, int digits) {
    if (std::isnan(value)) return "";
    std::array<char, 400> text{};  // the largest double has 309 digits before the point
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value, format, digits);
    return std::string(text.data(), end.ptr);
}

}  // namespace

CTextFile::CTextFile(std::string file) : m_file(std::move(file)) {
    errno = 0;
    m_out.open(m_file, std::ios::binary);
    if (!m_out) fail(m_file, "cannot be written");
}

void CTextFile::close() {
    errno = 0;
    m_out.close();  // also flushes
    if (!m_out) fail(m_file, "cannot be written");
}

std::string number(double value) { return written(value, std::chars_format::general, 9); }
std::string stamp(double seconds) { return fixed(seconds, 6); }
std::string fixed(double value, int decimals) {
    return written(value, std::chars_format::fixed, decimals);
}

std::string readText(const std::string& file) {
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    if (!in) fail(file, "cannot be read");
    std::ostringstream text;
    text << in.rdbuf();
    // a folder opens well, and the stream hides why nothing came
    if (in.bad() || errno == EISDIR || errno == EIO) fail(file, "cannot be read");
    return text.str();
}

bool parseNumber(const std::string& text, double& value) {
    const char* end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && last == end && !text.empty();
}

}  // namespace salma::viz
