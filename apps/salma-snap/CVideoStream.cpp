// SPDX-License-Identifier: BSD-3-Clause
#include "CVideoStream.h"

#include <libv4l2.h>
#include <poll.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <ctime>
#include <sstream>

namespace salma::apps {
namespace {

constexpr unsigned kBuffers = 4;

v4l2_buffer captureBuffer(unsigned index = 0) {
    v4l2_buffer buffer{};
    buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    buffer.memory = V4L2_MEMORY_MMAP;
    buffer.index = index;
    return buffer;
}

double now(clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

/// When the picture was taken [s since 1970].
double timeOf(const v4l2_buffer& buffer) {
    const double wall = now(CLOCK_REALTIME);
    const double stamp = static_cast<double>(buffer.timestamp.tv_sec) +
                         static_cast<double>(buffer.timestamp.tv_usec) * 1e-6;
    const bool monotonic =
        (buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
    const double age = now(CLOCK_MONOTONIC) - stamp;
    return monotonic && stamp > 0 && age >= 0 ? wall - age : wall;
}

}  // namespace

CVideoStream::CVideoStream(CVideoDevice& device) : m_device(device) {
    v4l2_requestbuffers request{};
    request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    request.memory = V4L2_MEMORY_MMAP;
    request.count = kBuffers;
    if (const int error = m_device.call(VIDIOC_REQBUFS, &request); error != 0)
        m_device.fail("gives no buffers", error);
    try {
        for (unsigned i = 0; i < request.count; ++i) map(i);
        v4l2_buf_type type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
        if (const int error = m_device.call(VIDIOC_STREAMON, &type); error != 0)
            m_device.fail("does not begin to stream", error);
    } catch (...) {
        release();
        throw;
    }
    m_streaming = true;
}

CVideoStream::~CVideoStream() { release(); }

void CVideoStream::map(unsigned index) {
    v4l2_buffer buffer = captureBuffer(index);
    if (const int error = m_device.call(VIDIOC_QUERYBUF, &buffer); error != 0)
        m_device.fail("does not tell a buffer", error);
    void* const start = v4l2_mmap(nullptr, buffer.length, PROT_READ | PROT_WRITE, MAP_SHARED,
                                  m_device.descriptor(), buffer.m.offset);
    if (start == MAP_FAILED) m_device.fail("does not share a buffer", errno);
    m_buffers.push_back({start, buffer.length});
    if (const int error = m_device.call(VIDIOC_QBUF, &buffer); error != 0)
        m_device.fail("does not take a buffer", error);
}

void CVideoStream::release() {
    v4l2_buf_type type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (m_streaming) m_device.call(VIDIOC_STREAMOFF, &type);
    for (const TBuffer& buffer : m_buffers) v4l2_munmap(buffer.start, buffer.length);
    v4l2_requestbuffers request{};
    request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    request.memory = V4L2_MEMORY_MMAP;
    m_device.call(VIDIOC_REQBUFS, &request);
}

CVideoStream::TFrame CVideoStream::next(double timeout) {
    pollfd descriptor{m_device.descriptor(), POLLIN, 0};
    const int ready = poll(&descriptor, 1, static_cast<int>(std::ceil(timeout * 1000)));
    if (ready == 0) {
        std::ostringstream seconds;
        seconds << timeout;
        throw std::runtime_error(m_device.path() + ": gave no picture for " + seconds.str() + " s");
    }
    TFrame frame;
    v4l2_buffer buffer = captureBuffer();
    const int error = ready < 0 ? errno : m_device.call(VIDIOC_DQBUF, &buffer);
    if (error == EAGAIN || error == EIO || error == EPIPE || error == EINTR) {
        frame.problem = std::string("lost: ") + std::strerror(error);
        return frame;
    }
    if (error != 0) m_device.fail("gives no picture", error);
    if (buffer.index >= m_buffers.size()) m_device.fail("gives a buffer that is none", EPROTO);
    const auto* const start = static_cast<const std::uint8_t*>(m_buffers[buffer.index].start);
    const std::size_t length =
        std::min<std::size_t>(buffer.bytesused, m_buffers[buffer.index].length);
    frame.bytes.assign(start, start + length);
    frame.time = timeOf(buffer);
    frame.sequence = buffer.sequence;
    frame.damaged = (buffer.flags & V4L2_BUF_FLAG_ERROR) != 0;
    if (const int queued = m_device.call(VIDIOC_QBUF, &buffer); queued != 0)
        m_device.fail("does not take a buffer back", queued);
    return frame;
}

}  // namespace salma::apps
