// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/serialization/CSerializable.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace salma::apps {

class CDiskSync;

/** A rawlog that grows in whole gzip members.
 *
 * A member holds whole objects and is written at once, so that whatever ends the program, the file
 * is whole but for the member that was being written. Twice a second a thread of its own asks the
 * system to put it on the disk (fdatasync, or syncfs, which also covers pictures beside the log),
 * so that a slow disk does not hold up the capture. Readers of gzip, zlib's and so MRPT's among
 * them, take the members for one file. Not for several threads. */
class CCaptureFile {
 public:
    struct TOptions {
        int compression{1};     //!< 0 to 9.
        bool overwrite{false};  //!< Take the place of a file that exists.
        bool syncWholeFileSystem{false};
    };

    /// \throw std::runtime_error naming `file`: it exists, or cannot be made.
    CCaptureFile(const std::string& file, const TOptions& options);
    /// What was not completed is lost.
    ~CCaptureFile();
    CCaptureFile(const CCaptureFile&) = delete;
    CCaptureFile& operator=(const CCaptureFile&) = delete;

    /// Adds to the member that is being filled. \throw what the object's serialisation throws; the
    /// file is then as before.
    void add(const mrpt::serialization::CSerializable& object);

    /** Writes the member; nothing if it is empty.
     * \throw std::runtime_error naming the file and the cause, such as a full disk. The file then
     * ends with the member before, and the objects of this one are lost. */
    void completeMember();

    /// Completes the last member and waits until all is on the disk. \throw as completeMember().
    void close();

    std::size_t waiting() const { return m_waiting; }  //!< Objects in the member being filled.
    std::size_t waitingBytes() const;                  //!< Their size.
    std::size_t objects() const { return m_objects; }  //!< In completed members.
    std::uint64_t bytes() const { return m_bytes; }    //!< Length of the file.
    const std::string& file() const { return m_file; }

 private:
    class CBuffer;

    [[noreturn]] void fail(const std::string& problem) const;
    void writeAll(const std::string& data);

    std::string m_file;
    int m_compression;
    int m_descriptor{-1};
    std::unique_ptr<CBuffer> m_buffer;
    std::unique_ptr<CDiskSync> m_sync;
    std::size_t m_waiting{0};
    std::size_t m_objects{0};
    std::uint64_t m_bytes{0};
    std::chrono::steady_clock::time_point m_lastSync{};
};

}  // namespace salma::apps
