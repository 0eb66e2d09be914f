// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace salma::apps {

/** A folder of results that appears whole or not at all.
 *
 * Files are written to path(), a folder beside the wanted one; publish() moves it into place.
 * Without publish() the destructor removes what was written. */
class COutputFolder {
 public:
    /** \throw std::runtime_error if the folder cannot be made, or if `target` exists, is not empty
     * and was not written by a program of this project (so that no other folder is ever replaced).
     */
    explicit COutputFolder(const std::filesystem::path& target);
    ~COutputFolder();
    COutputFolder(const COutputFolder&) = delete;
    COutputFolder& operator=(const COutputFolder&) = delete;

    /// Where to write.
    const std::filesystem::path& path() const { return m_staging; }
    std::filesystem::path operator/(const std::string& name) const { return m_staging / name; }

    /// Writes a file. \throw std::runtime_error naming it if that cannot be done.
    void write(const std::string& name, const std::string& content) const;

    /// Replaces `target` by what was written. \throw std::runtime_error
    void publish();

    /// Adds what was written to `target`, file by file, and keeps what is there under other names.
    void publishInto();

 private:
    std::filesystem::path m_target;
    std::filesystem::path m_staging;
};

}  // namespace salma::apps
