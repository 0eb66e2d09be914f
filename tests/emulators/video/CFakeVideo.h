// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <linux/videodev2.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace salma::test {

/** A V4L2 capture card as its driver shows it to the system: what open, ioctl and mmap on its file
 * would do. Two inputs, PAL and NTSC, a picture that moves, and faults on request.
 *
 * Set up by a text such as "formats=YUYV:MJPG,size=640x480,fault=truncated,from=3,to=5": the pixel
 * formats in their order, the only size, and a fault for pictures 3 to 5. The faults:
 * truncated, black, damaged (flag), eio, silent, unplugged, restless (another input and standard
 * than asked for). */
class CFakeVideo {
 public:
    explicit CFakeVideo(const std::string& setup);
    CFakeVideo(const CFakeVideo&) = delete;
    CFakeVideo& operator=(const CFakeVideo&) = delete;

    /// A file descriptor that becomes readable when a picture is there.
    int open();
    /// \return 0, or errno
    int ioctl(unsigned long request, void* argument);
    /// Memory of the buffer at `offset`; null if there is none.
    void* map(std::int64_t offset) const;

 private:
    struct TBuffer {
        std::uint8_t* memory{nullptr};
        bool queued{false};
    };

    bool faulty() const;
    int enumerate(unsigned long request, void* argument) const;
    int set(unsigned long request, void* argument);
    int setFormat(v4l2_pix_format& pix, bool keep);
    int requestBuffers(v4l2_requestbuffers& request);
    int queryBuffer(v4l2_buffer& buffer) const;
    int queue(v4l2_buffer& buffer);
    int dequeue(v4l2_buffer& buffer);
    void tick(bool on) const;
    /// Fills `buffer` with the picture of that number. \return the bytes used
    std::uint32_t draw(std::uint8_t* memory) const;
    std::uint8_t grey(int x, int y) const;
    std::uint32_t lineOf(std::uint32_t fourcc) const;

    std::vector<std::uint32_t> m_formats;
    std::string m_fault;
    long m_from{0}, m_to{-1};  //!< Pictures with the fault; -1: to the end.
    int m_onlyWidth{0}, m_onlyHeight{0};
    bool m_interlaced{false}, m_hasStandards{true};
    std::uint32_t m_bufferSize{0};

    int m_timer{-1};
    int m_input{0};
    v4l2_std_id m_standard{V4L2_STD_PAL};
    v4l2_pix_format m_pix{};
    std::vector<TBuffer> m_buffers;
    std::vector<std::uint32_t> m_queue;
    long m_number{0};
};

}  // namespace salma::test
