// SPDX-License-Identifier: BSD-3-Clause
#include "CCaptureFile.h"

#include <fcntl.h>
#include <mrpt/serialization/CArchive.h>
#include <sys/file.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "CDiskSync.h"

namespace salma::apps {
namespace {

constexpr auto kSyncPause = std::chrono::milliseconds(500);  // cards wear out

/// `data` as one gzip member.
std::string gzipMember(const std::string& data, int level) {
    constexpr int kGzip = 15 + 16;  // largest window, gzip's frame
    constexpr std::size_t kPart = 1U << 30;
    z_stream stream{};
    if (deflateInit2(&stream, level, Z_DEFLATED, kGzip, 8, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::runtime_error("zlib cannot begin a member");
    std::string member(deflateBound(&stream, data.size()), '\0');
    std::size_t in = 0, out = 0;
    for (int code = Z_OK; code != Z_STREAM_END;) {
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data() + in));
        stream.avail_in = static_cast<uInt>(std::min(data.size() - in, kPart));
        stream.next_out = reinterpret_cast<Bytef*>(member.data() + out);
        stream.avail_out = static_cast<uInt>(std::min(member.size() - out, kPart));
        const uInt given = stream.avail_in, room = stream.avail_out;
        code = deflate(&stream, in + given == data.size() ? Z_FINISH : Z_NO_FLUSH);
        in += given - stream.avail_in;
        out += room - stream.avail_out;
        if (code != Z_OK && code != Z_STREAM_END) {
            deflateEnd(&stream);
            throw std::runtime_error("zlib cannot complete a member");
        }
    }
    deflateEnd(&stream);
    member.resize(out);
    return member;
}

}  // namespace

/// The objects of a member before they are packed.
class CCaptureFile::CBuffer : public mrpt::serialization::CArchive {
 public:
    std::string data;

 protected:
    std::size_t write(const void* bytes, std::size_t count) override {
        data.append(static_cast<const char*>(bytes), count);
        return count;
    }
    std::size_t read(void*, std::size_t) override {
        throw std::logic_error("a log that is written cannot be read");
    }
    std::string getArchiveDescription() const override { return "capture"; }
};

CCaptureFile::CCaptureFile(const std::string& file, const TOptions& options)
    : m_file(file), m_compression(options.compression), m_buffer(std::make_unique<CBuffer>()) {
    const int mustBeNew = options.overwrite ? 0 : O_EXCL;
    constexpr mode_t kForAll = 0666;  // less what the user's mask takes away
    m_descriptor =
        open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | mustBeNew, kForAll);
    if (m_descriptor < 0)
        fail(errno == EEXIST ? "exists; --overwrite would replace it" : std::strerror(errno));
    if (flock(m_descriptor, LOCK_EX | LOCK_NB) != 0) fail("in use by another program");
    [[maybe_unused]] const int ignored = ftruncate(m_descriptor, 0);  // devices have no length
    m_sync = std::make_unique<CDiskSync>(m_descriptor, options.syncWholeFileSystem);
}

CCaptureFile::~CCaptureFile() {
    m_sync.reset();  // before its file is closed
    if (m_descriptor >= 0) ::close(m_descriptor);
}

void CCaptureFile::fail(const std::string& problem) const {
    throw std::runtime_error(m_file + ": cannot be written: " + problem);
}

std::size_t CCaptureFile::waitingBytes() const { return m_buffer->data.size(); }

void CCaptureFile::add(const mrpt::serialization::CSerializable& object) {
    const std::size_t before = m_buffer->data.size();
    try {
        *m_buffer << object;
    } catch (...) {
        m_buffer->data.resize(before);
        throw;
    }
    ++m_waiting;
}

void CCaptureFile::completeMember() {
    if (m_sync->error() != 0) fail(std::strerror(m_sync->error()));
    if (m_waiting == 0) return;
    const std::string member = gzipMember(m_buffer->data, m_compression);
    const std::size_t objects = m_waiting;
    m_buffer->data.clear();
    m_waiting = 0;
    writeAll(member);
    m_objects += objects;
    m_bytes += member.size();
    if (const auto now = std::chrono::steady_clock::now(); now - m_lastSync >= kSyncPause) {
        m_sync->request();
        m_lastSync = now;
    }
}

void CCaptureFile::writeAll(const std::string& data) {
    for (std::size_t done = 0; done < data.size();) {
        const ssize_t n = write(m_descriptor, data.data() + done, data.size() - done);
        if (n > 0) {
            done += static_cast<std::size_t>(n);
        } else if (errno != EINTR) {
            const int cause = n < 0 ? errno : ENOSPC;
            // What was begun of the member goes, so that the file ends with a whole one.
            [[maybe_unused]] const int ignored =
                ftruncate(m_descriptor, static_cast<off_t>(m_bytes));
            fail(std::strerror(cause));
        }
    }
}

void CCaptureFile::close() {
    completeMember();
    m_sync->request();
    m_sync->finish();
    if (m_sync->error() != 0) fail(std::strerror(m_sync->error()));
    const int descriptor = std::exchange(m_descriptor, -1);
    m_sync.reset();
    if (::close(descriptor) != 0) fail(std::strerror(errno));
}

}  // namespace salma::apps
