// SPDX-License-Identifier: BSD-3-Clause
#include "CFakeVideo.h"

#include <sys/mman.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

namespace salma::test {
namespace {

constexpr std::uint32_t kPage = 4096;
constexpr int kPeriod = 10'000'000;  // nanoseconds between two pictures

std::uint32_t fourccOf(const std::string& name) {
    return v4l2_fourcc(static_cast<unsigned char>(name[0]), static_cast<unsigned char>(name[1]),
                       static_cast<unsigned char>(name[2]), static_cast<unsigned char>(name[3]));
}

template <std::size_t N>
void put(__u8 (&field)[N], const char* text) {
    std::snprintf(reinterpret_cast<char*>(field), N, "%s", text);
}

}  // namespace

CFakeVideo::CFakeVideo(const std::string& setup) {
    std::string formats = "YUYV";
    std::istringstream entries(setup);
    for (std::string entry; std::getline(entries, entry, ',');) {
        const auto equals = entry.find('=');
        const std::string key = entry.substr(0, equals), value = entry.substr(equals + 1);
        if (key == "formats") formats = value;
        if (key == "fault") m_fault = value;
        if (key == "from") m_from = std::stol(value);
        if (key == "to") m_to = std::stol(value);
        if (key == "size") std::sscanf(value.c_str(), "%dx%d", &m_onlyWidth, &m_onlyHeight);
        if (key == "interlaced") m_interlaced = value == "1";
        if (key == "standards") m_hasStandards = value == "1";
    }
    std::istringstream names(formats);
    for (std::string name; std::getline(names, name, ':');) m_formats.push_back(fourccOf(name));
    v4l2_pix_format pix{};
    pix.width = 320;
    pix.height = 240;
    pix.pixelformat = m_formats[0];
    setFormat(pix, true);
}

int CFakeVideo::open() {
    m_timer = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
    return m_timer;
}

void CFakeVideo::tick(bool on) const {
    itimerspec times{};
    if (on) times.it_interval.tv_nsec = times.it_value.tv_nsec = kPeriod;
    timerfd_settime(m_timer, 0, &times, nullptr);
}

bool CFakeVideo::faulty() const {
    return !m_fault.empty() && m_number >= m_from && (m_to < 0 || m_number <= m_to);
}

int CFakeVideo::ioctl(unsigned long request, void* argument) {
    switch (static_cast<std::uint32_t>(request)) {
        case VIDIOC_G_FMT:
            static_cast<v4l2_format*>(argument)->fmt.pix = m_pix;
            return 0;
        case VIDIOC_S_FMT:
            return setFormat(static_cast<v4l2_format*>(argument)->fmt.pix, true);
        case VIDIOC_TRY_FMT:
            return setFormat(static_cast<v4l2_format*>(argument)->fmt.pix, false);
        case VIDIOC_REQBUFS:
            return requestBuffers(*static_cast<v4l2_requestbuffers*>(argument));
        case VIDIOC_QUERYBUF:
            return queryBuffer(*static_cast<v4l2_buffer*>(argument));
        case VIDIOC_QBUF:
            return queue(*static_cast<v4l2_buffer*>(argument));
        case VIDIOC_DQBUF:
            return dequeue(*static_cast<v4l2_buffer*>(argument));
        case VIDIOC_STREAMON:
            tick(true);
            return 0;
        case VIDIOC_STREAMOFF:
            tick(false);
            m_queue.clear();
            return 0;
        case VIDIOC_S_INPUT:
        case VIDIOC_S_STD:
            return set(request, argument);
        default:
            return enumerate(request, argument);
    }
}

int CFakeVideo::enumerate(unsigned long request, void* argument) const {
    const bool none = !m_hasStandards;
    switch (static_cast<std::uint32_t>(request)) {
        case VIDIOC_QUERYCAP: {
            auto& capability = *static_cast<v4l2_capability*>(argument);
            capability = {};
            put(capability.driver, "fake");
            put(capability.card, "Fake capture card");
            put(capability.bus_info, "nowhere");
            capability.device_caps = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
            capability.capabilities = capability.device_caps | V4L2_CAP_DEVICE_CAPS;
            return 0;
        }
        case VIDIOC_ENUM_FMT: {
            auto& format = *static_cast<v4l2_fmtdesc*>(argument);
            if (format.index >= m_formats.size()) return EINVAL;
            format.pixelformat = m_formats[format.index];
            format.flags = 0;
            put(format.description, "as the card has it");
            return 0;
        }
        case VIDIOC_ENUMINPUT: {
            auto& input = *static_cast<v4l2_input*>(argument);
            if (input.index > 1) return EINVAL;
            put(input.name, input.index == 0 ? "Composite" : "S-Video");
            input.type = V4L2_INPUT_TYPE_CAMERA;
            input.std = none ? 0 : V4L2_STD_PAL | V4L2_STD_NTSC;
            input.status = input.index == 1 ? V4L2_IN_ST_NO_SIGNAL : 0;
            return 0;
        }
        case VIDIOC_G_INPUT:
            *static_cast<int*>(argument) = m_input;
            return 0;
        case VIDIOC_G_STD:
            *static_cast<v4l2_std_id*>(argument) = m_standard;
            return none ? ENOTTY : 0;
        default:
            return ENOTTY;
    }
}

int CFakeVideo::set(unsigned long request, void* argument) {
    const bool restless = m_fault == "restless";
    if (static_cast<std::uint32_t>(request) == VIDIOC_S_INPUT) {
        const int wished = *static_cast<int*>(argument);
        if (wished < 0 || wished > 1) return EINVAL;
        if (!restless) m_input = wished;
        return 0;
    }
    const v4l2_std_id wished = *static_cast<v4l2_std_id*>(argument);
    if (!m_hasStandards) return ENOTTY;
    if ((wished & (V4L2_STD_PAL | V4L2_STD_NTSC)) == 0) return EINVAL;
    if (!restless) m_standard = wished & (V4L2_STD_PAL | V4L2_STD_NTSC);
    return 0;
}

std::uint32_t CFakeVideo::lineOf(std::uint32_t fourcc) const {
    if (fourcc == V4L2_PIX_FMT_YUYV || fourcc == V4L2_PIX_FMT_UYVY) return 2;
    return fourcc == V4L2_PIX_FMT_GREY || fourcc == V4L2_PIX_FMT_SBGGR8 ? 1 : 0;
}

int CFakeVideo::setFormat(v4l2_pix_format& pix, bool keep) {
    const bool known =
        std::find(m_formats.begin(), m_formats.end(), pix.pixelformat) != m_formats.end();
    if (!known) pix.pixelformat = m_formats[0];
    const __u32 most = (m_standard & V4L2_STD_PAL) != 0 ? 576 : 480;
    pix.width = std::min<__u32>(std::max<__u32>(pix.width, 16), 768) / 16 * 16;
    pix.height = std::min<__u32>(std::max<__u32>(pix.height, 16), most) / 2 * 2;
    if (m_onlyWidth > 0) {
        pix.width = static_cast<__u32>(m_onlyWidth);
        pix.height = static_cast<__u32>(m_onlyHeight);
    }
    pix.field = m_interlaced ? V4L2_FIELD_INTERLACED : V4L2_FIELD_NONE;
    pix.bytesperline = pix.width * lineOf(pix.pixelformat);
    pix.sizeimage = pix.bytesperline > 0 ? pix.bytesperline * pix.height : pix.width * pix.height;
    if (keep) m_pix = pix;
    return 0;
}

int CFakeVideo::requestBuffers(v4l2_requestbuffers& request) {
    for (const TBuffer& buffer : m_buffers) munmap(buffer.memory, m_bufferSize);
    m_buffers.clear();
    m_queue.clear();
    m_bufferSize = (m_pix.sizeimage + kPage - 1) / kPage * kPage;
    for (__u32 i = 0; i < request.count; ++i) {
        TBuffer buffer;
        // Shared: the same pages lie under what map() gives.
        buffer.memory = static_cast<std::uint8_t*>(
            mmap(nullptr, m_bufferSize, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
        m_buffers.push_back(buffer);
    }
    return 0;
}

void* CFakeVideo::map(std::int64_t offset) const {
    const auto index = static_cast<std::size_t>(offset) / kPage;
    if (index >= m_buffers.size()) return nullptr;
    // A second view of the same pages, which the program may unmap for itself.
    void* const view = mremap(m_buffers[index].memory, 0, m_bufferSize, MREMAP_MAYMOVE);
    return view == MAP_FAILED ? nullptr : view;
}

int CFakeVideo::queryBuffer(v4l2_buffer& buffer) const {
    if (buffer.index >= m_buffers.size()) return EINVAL;
    buffer.length = m_bufferSize;
    buffer.m.offset = buffer.index * kPage;
    buffer.flags = 0;
    return 0;
}

int CFakeVideo::queue(v4l2_buffer& buffer) {
    if (buffer.index >= m_buffers.size()) return EINVAL;
    m_queue.push_back(buffer.index);
    return 0;
}

int CFakeVideo::dequeue(v4l2_buffer& buffer) {
    std::uint64_t ticks = 0;
    if (faulty() && m_fault == "unplugged") return ENODEV;
    if (::read(m_timer, &ticks, sizeof ticks) != sizeof ticks || m_queue.empty()) return EAGAIN;
    if (faulty() && m_fault == "silent") {
        tick(false);
        return EAGAIN;
    }
    if (faulty() && m_fault == "eio") {
        ++m_number;
        return EIO;
    }
    const std::uint32_t index = m_queue.front();
    m_queue.erase(m_queue.begin());
    buffer.index = index;
    buffer.bytesused = draw(m_buffers[index].memory);
    if (faulty() && m_fault == "truncated") buffer.bytesused /= 3;
    buffer.flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
    if (faulty() && m_fault == "damaged") buffer.flags |= V4L2_BUF_FLAG_ERROR;
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    buffer.timestamp.tv_sec = now.tv_sec;
    buffer.timestamp.tv_usec = now.tv_nsec / 1000;
    buffer.sequence = static_cast<__u32>(m_number++);
    buffer.field = m_pix.field;
    buffer.length = m_bufferSize;
    return 0;
}

std::uint8_t CFakeVideo::grey(int x, int y) const {
    if (faulty() && m_fault == "black") return 5;
    // Lines of the lower field were taken later: the pattern has moved by 40 pixels.
    const int shift = m_interlaced && y % 2 == 1 ? 40 : 0;
    return (x + shift) % 80 < 40 ? 60 : 180;
}

std::uint32_t CFakeVideo::draw(std::uint8_t* memory) const {
    const int width = static_cast<int>(m_pix.width), height = static_cast<int>(m_pix.height);
    cv::Mat picture(height, width, CV_8UC1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) picture.at<std::uint8_t>(y, x) = grey(x, y);
    const std::uint32_t line = lineOf(m_pix.pixelformat);
    if (line == 0) {
        std::vector<std::uint8_t> jpeg;
        cv::imencode(".jpg", picture, jpeg, {cv::IMWRITE_JPEG_QUALITY, 90});
        const std::size_t size = std::min<std::size_t>(jpeg.size(), m_bufferSize);
        std::memcpy(memory, jpeg.data(), size);
        return static_cast<std::uint32_t>(size);
    }
    const int luma = m_pix.pixelformat == V4L2_PIX_FMT_UYVY ? 1 : 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            std::uint8_t* const pixel =
                memory + (static_cast<std::ptrdiff_t>(y) * width + x) * static_cast<int>(line);
            pixel[luma] = picture.at<std::uint8_t>(y, x);
            if (line == 2) pixel[1 - luma] = 128;  // no colour
        }
    return m_pix.sizeimage;
}

}  // namespace salma::test
