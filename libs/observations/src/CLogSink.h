// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/serialization/CArchive.h>
#include <zlib.h>

#include <string>

namespace salma::observations {

/** A gzip rawlog that is written beside its place and appears there whole or not at all.
 *
 * Not MRPT's gzip stream, for that one cannot tell that the disk was full when it was closed. */
class CLogSink : public mrpt::serialization::CArchive {
 public:
    /// \throw std::runtime_error naming `file` if it cannot be written.
    explicit CLogSink(const std::string& file);
    /// Removes what was not published.
    ~CLogSink() override;
    CLogSink(const CLogSink&) = delete;
    CLogSink& operator=(const CLogSink&) = delete;

    /// Ends the file and moves it into place. \throw std::runtime_error naming it.
    void publish();

 protected:
    std::size_t read(void* data, std::size_t bytes) override;
    std::size_t write(const void* data, std::size_t bytes) override;

 private:
    [[noreturn]] void fail(const std::string& problem) const;

    std::string m_file;
    std::string m_staging;
    gzFile m_stream{nullptr};
};

}  // namespace salma::observations
