// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/serialization/CArchive.h>
#include <zlib.h>

#include <cstdint>
#include <memory>
#include <string>

#include "CCountGuard.h"

namespace salma::observations {

/** The bytes of a rawlog, gzip or plain, as MRPT's readers take them.
 *
 * MRPT's own gzip stream takes a broken-off file for one that ends, and its readers take a short
 * read for a whole one. Here the file is unpacked once for its check sums and its true length
 * before anything is read from it, and a read beyond the end throws. */
class CLogArchive : public mrpt::serialization::CArchive {
 public:
    /** \param acceptDamage Take a damaged place for the end, where damage() says what is wrong.
     * \throw std::runtime_error "FILE: ..." if it is missing, unreadable, empty or damaged. */
    explicit CLogArchive(const std::string& file, bool acceptDamage = false);

    bool atEnd() const { return m_position == m_size; }
    std::uint64_t position() const { return m_position; }  //!< In what is unpacked.
    std::uint64_t size() const { return m_size; }          //!< Unpacked.
    /// What zlib says of the damaged place at which the file is taken to end; "" for none.
    const std::string& damage() const { return m_damage; }
    /// Bytes of the file from the damaged place on.
    std::uint64_t packedBytesLost() const { return m_packedBytesLost; }

    /// Bytes as they are, without the checks that objects undergo. \throw as read() does.
    void readBytes(void* data, std::size_t bytes);

    /// The gzip stream has no end.
    bool truncated() const { return m_truncated; }

    /// Something was read beyond the end.
    bool brokeOff() const { return m_brokeOff; }

    /// Does it begin as an MRPT object does? What the file calls that object's class is printable.
    bool beginsAsRawlog() const;

    /// Name of the class whose object was begun last, "" before the first.
    const std::string& lastClass() const { return m_lastClass; }

    /// What was read and refused here; "" if nothing was.
    const std::string& refusal() const { return m_refusal; }

    std::string getArchiveDescription() const override { return m_file; }

 protected:
    std::size_t read(void* data, std::size_t bytes) override;
    std::size_t write(const void* data, std::size_t bytes) override;

 private:
    /// Unpacks the whole file and drops the bytes. Sets m_size, m_truncated, m_damage and m_head.
    void inspect();
    /// Counts the bytes between m_size and a damaged place, which zlib gives one by one only.
    void countUpToDamage();
    /// Follows the headers of objects that pass by, `bytes` of them from position `at`.
    void notice(std::uint64_t at, const std::uint8_t* data, std::size_t bytes);

    struct TClose {
        void operator()(gzFile_s* file) const { gzclose_r(file); }
    };
    using TGzip = std::unique_ptr<gzFile_s, TClose>;
    TGzip open() const;

    std::string m_file;
    bool m_acceptDamage;
    std::string m_damage;
    std::uint64_t m_packedBytesLost{0};
    TGzip m_stream;
    std::string m_head;  //!< First bytes of the content.
    std::uint64_t m_size{0};
    std::uint64_t m_position{0};
    bool m_truncated{false};
    bool m_brokeOff{false};
    std::size_t m_nameLength{0};   //!< Length of the class name that must follow now; 0 for none.
    bool m_versionFollows{false};  //!< The name was just read.
    std::string m_lastClass;
    std::string m_refusal;
    CCountGuard m_guard;
};

}  // namespace salma::observations
