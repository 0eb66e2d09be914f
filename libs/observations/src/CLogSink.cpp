// SPDX-License-Identifier: BSD-3-Clause
#include "CLogSink.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace fs = std::filesystem;

namespace salma::observations {

CLogSink::CLogSink(const std::string& file)
    : m_file(file), m_staging(file + ".partial-" + std::to_string(getpid())) {
    errno = 0;
    m_stream = gzopen(m_staging.c_str(), "wb");
    if (m_stream == nullptr) fail(std::strerror(errno));
}

CLogSink::~CLogSink() {
    if (m_stream != nullptr) gzclose_w(m_stream);
    std::error_code ignored;
    fs::remove(m_staging, ignored);
}

void CLogSink::fail(const std::string& problem) const {
    throw std::runtime_error(m_file + ": cannot be written: " + problem);
}

void CLogSink::publish() {
    errno = 0;
    const int code = gzclose_w(m_stream);
    m_stream = nullptr;
    if (code != Z_OK) fail(errno != 0 ? std::strerror(errno) : "the end is missing");
    std::error_code error;
    fs::rename(m_staging, m_file, error);
    if (error) fail(error.message());
}

std::size_t CLogSink::read(void*, std::size_t) {
    throw std::logic_error("a log that is written cannot be read");
}

std::size_t CLogSink::write(const void* data, std::size_t bytes) {
    const auto* source = static_cast<const char*>(data);
    for (std::size_t done = 0; done < bytes;) {
        const std::size_t part = std::min<std::size_t>(bytes - done, 1U << 30);
        errno = 0;
        const int n = gzwrite(m_stream, source + done, static_cast<unsigned>(part));
        if (n <= 0) fail(errno != 0 ? std::strerror(errno) : "zlib refuses");
        done += static_cast<std::size_t>(n);
    }
    return bytes;
}

}  // namespace salma::observations
