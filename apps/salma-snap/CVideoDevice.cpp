// SPDX-License-Identifier: BSD-3-Clause
#include "CVideoDevice.h"

#include <fcntl.h>
#include <libv4l2.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "videoNames.h"

namespace salma::apps {
namespace {

/// Text of a fixed-length field, which a driver may leave without its end.
template <std::size_t N>
std::string textOf(const __u8 (&field)[N]) {
    return {reinterpret_cast<const char*>(field), strnlen(reinterpret_cast<const char*>(field), N)};
}

std::string reason(int error) {
    if (error == ENODEV || error == ENXIO) return "the device is gone";
    if (error == EBUSY) return "in use by another program";
    return std::strerror(error);
}

CVideoDevice::TFormat fromPix(const v4l2_pix_format& pix) {
    CVideoDevice::TFormat format;
    format.width = static_cast<int>(pix.width);
    format.height = static_cast<int>(pix.height);
    format.fourcc = pix.pixelformat;
    format.field = pix.field;
    format.bytesPerLine = pix.bytesperline;
    format.bytes = pix.sizeimage;
    return format;
}

}  // namespace

CVideoDevice::CVideoDevice(const std::string& path) : m_path(path) {
    // libv4l2 writes to standard error by itself; what it meets is told here in one line.
    if (v4l2_log_file == nullptr) v4l2_log_file = std::fopen("/dev/null", "w");
    m_descriptor.value = v4l2_open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    if (m_descriptor.value < 0) {
        const int error = errno;
        if (error == ENOTTY || error == EINVAL)
            throw std::runtime_error(path + ": is not a video device");
        fail("cannot be opened", error);
    }
    require(VIDIOC_QUERYCAP, &m_capability, "does not tell its capabilities");
    const auto can = (m_capability.capabilities & V4L2_CAP_DEVICE_CAPS) != 0
                         ? m_capability.device_caps
                         : m_capability.capabilities;
    const bool usable = (can & V4L2_CAP_VIDEO_CAPTURE) != 0 && (can & V4L2_CAP_STREAMING) != 0;
    if (!usable) throw std::runtime_error(path + ": is no device that captures and streams video");
}

CVideoDevice::TDescriptor::~TDescriptor() {
    if (value >= 0) v4l2_close(value);
}

std::string CVideoDevice::driver() const { return textOf(m_capability.driver); }
std::string CVideoDevice::card() const { return textOf(m_capability.card); }
std::string CVideoDevice::bus() const { return textOf(m_capability.bus_info); }

int CVideoDevice::call(unsigned long request, void* argument) const {
    while (v4l2_ioctl(m_descriptor.value, request, argument) != 0)
        if (errno != EINTR) return errno;
    return 0;
}

void CVideoDevice::fail(const std::string& action, int error) const {
    const std::string message = m_path + ": " + action + ": " + reason(error);
    if (error == ENODEV || error == ENXIO) throw CDeviceGone(message);
    throw std::runtime_error(message);
}

void CVideoDevice::require(unsigned long request, void* argument, const std::string& action) const {
    if (const int error = call(request, argument); error != 0) fail(action, error);
}

std::vector<CVideoDevice::TInput> CVideoDevice::inputs() {
    std::vector<TInput> inputs;
    while (true) {
        v4l2_input input{};
        input.index = static_cast<__u32>(inputs.size());
        if (call(VIDIOC_ENUMINPUT, &input) != 0) return inputs;
        constexpr __u32 kNothing = V4L2_IN_ST_NO_SIGNAL | V4L2_IN_ST_NO_POWER;
        inputs.push_back({static_cast<int>(input.index), textOf(input.name), input.std,
                          (input.status & kNothing) != 0});
    }
}

std::vector<CVideoDevice::TPixelFormat> CVideoDevice::pixelFormats() {
    std::vector<TPixelFormat> formats;
    while (true) {
        v4l2_fmtdesc description{};
        description.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
        description.index = static_cast<__u32>(formats.size());
        if (call(VIDIOC_ENUM_FMT, &description) != 0) return formats;
        formats.push_back({description.pixelformat, textOf(description.description),
                           (description.flags & V4L2_FMT_FLAG_EMULATED) != 0,
                           sizesOf(description.pixelformat)});
    }
}

std::string CVideoDevice::sizesOf(std::uint32_t fourcc) const {
    std::string sizes;
    const auto by = [](__u32 width, __u32 height) {
        return std::to_string(width) + "x" + std::to_string(height);
    };
    for (__u32 i = 0;; ++i) {
        v4l2_frmsizeenum size{};
        size.index = i;
        size.pixel_format = fourcc;
        if (call(VIDIOC_ENUM_FRAMESIZES, &size) != 0) return sizes;
        if (size.type != V4L2_FRMSIZE_TYPE_DISCRETE)
            return by(size.stepwise.min_width, size.stepwise.min_height) + " to " +
                   by(size.stepwise.max_width, size.stepwise.max_height);
        sizes += (sizes.empty() ? "" : " ") + by(size.discrete.width, size.discrete.height);
    }
}

void CVideoDevice::setInput(int index) {
    require(VIDIOC_S_INPUT, &index, "input " + std::to_string(index) + " cannot be set");
}

int CVideoDevice::input() {
    int index = 0;
    const int error = call(VIDIOC_G_INPUT, &index);
    if (error != 0 && error != ENOTTY && error != EINVAL) fail("does not tell its input", error);
    return index;
}

void CVideoDevice::setStandard(std::uint64_t set) {
    v4l2_std_id id = set;
    require(VIDIOC_S_STD, &id, "standard " + nameOfStandard(set) + " cannot be set");
}

std::uint64_t CVideoDevice::standard() {
    v4l2_std_id id = 0;
    const int error = call(VIDIOC_G_STD, &id);
    if (error == ENOTTY || error == EINVAL || error == ENODATA) return 0;
    if (error != 0) fail("does not tell its standard", error);
    return id;
}

CVideoDevice::TFormat CVideoDevice::setFormat(int width, int height, std::uint32_t fourcc) {
    v4l2_format wish{};
    wish.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    wish.fmt.pix.width = static_cast<__u32>(width);
    wish.fmt.pix.height = static_cast<__u32>(height);
    wish.fmt.pix.pixelformat = fourcc;
    wish.fmt.pix.field = V4L2_FIELD_ANY;
    require(VIDIOC_S_FMT, &wish, "its format cannot be set");
    return format();
}

CVideoDevice::TFormat CVideoDevice::format() {
    v4l2_format state{};
    state.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    require(VIDIOC_G_FMT, &state, "does not tell its format");
    return fromPix(state.fmt.pix);
}

}  // namespace salma::apps
