// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "TRunScore.h"

namespace salma::apps {

/** The results of a study, one line of JSON each, which survive that the program is killed.
 *
 * A line is `{"md5": check sum of the rest, "result": {...}}`. It is on the disk when add()
 * returns. A last line without line break is what a killed program left, and is cut off. The file
 * is locked against other programs of this kind while the object lives. */
class CResultFile {
 public:
    /** Opens or makes `file` and reads it.
     * \throw std::runtime_error if it cannot be read, written or locked, or "FILE:LINE: problem"
     * for a line that is not as it was written. */
    explicit CResultFile(const std::filesystem::path& file);
    ~CResultFile();
    CResultFile(const CResultFile&) = delete;
    CResultFile& operator=(const CResultFile&) = delete;

    /// All lines, in the order of the file.
    const std::vector<TRunResult>& results() const { return m_results; }

    /// \throw std::runtime_error
    void add(const TRunResult& result);

 private:
    void readLines(const std::string& text);

    std::filesystem::path m_file;
    int m_descriptor{-1};
    std::vector<TRunResult> m_results;
};

/// A result as a line without line break, and back. \throw std::invalid_argument with the problem
std::string asLine(const TRunResult& result);
TRunResult resultOf(const std::string& line);

/// Hash of a text and of a file's content, as hexadecimal digits. \throw std::runtime_error
std::string md5Of(const std::string& text);
std::string md5OfFile(const std::filesystem::path& file);

}  // namespace salma::apps
