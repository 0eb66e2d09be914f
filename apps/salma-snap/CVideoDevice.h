// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <linux/videodev2.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace salma::apps {

/// Thrown where the device itself is gone, so that trying again is in vain.
struct CDeviceGone : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/** A V4L2 capture device, opened through libv4l2, which also offers formats that it converts to.
 *
 * What a device makes of a wish is never assumed but read back. Errors are std::runtime_error and
 * name the device and the call. */
class CVideoDevice {
 public:
    struct TInput {
        int index{0};
        std::string name;
        std::uint64_t standards{0};  //!< Set of V4L2_STD_...
        bool noSignal{false};        //!< Nothing is connected, or it is off.
    };
    struct TPixelFormat {
        std::uint32_t fourcc{0};
        std::string description;
        bool converted{false};  //!< By libv4l2, not by the device.
        std::string sizes;      //!< As text; "" if the device does not tell.
    };
    struct TFormat {
        int width{0}, height{0};
        std::uint32_t fourcc{0};
        std::uint32_t field{0};         //!< V4L2_FIELD_...
        std::uint32_t bytesPerLine{0};  //!< 0 for compressed formats.
        std::uint32_t bytes{0};         //!< Of a whole picture; of compressed formats the most.
    };

    /// \throw also if it is no device for capture, or cannot stream.
    explicit CVideoDevice(const std::string& path);
    CVideoDevice(const CVideoDevice&) = delete;
    CVideoDevice& operator=(const CVideoDevice&) = delete;

    const std::string& path() const { return m_path; }
    int descriptor() const { return m_descriptor.value; }
    std::string driver() const;
    std::string card() const;
    std::string bus() const;

    std::vector<TInput> inputs();
    std::vector<TPixelFormat> pixelFormats();

    void setInput(int index);
    int input();
    /// Set of one or more standards; the device chooses among them.
    void setStandard(std::uint64_t set);
    /// What is set; 0 for devices that know no standards.
    std::uint64_t standard();
    /// Asks for this format and returns what the device made of it.
    TFormat setFormat(int width, int height, std::uint32_t fourcc);
    TFormat format();

    /// One ioctl, repeated when a signal interrupts it. \return 0, or errno
    int call(unsigned long request, void* argument) const;
    /// \throw CDeviceGone or std::runtime_error saying that `action` failed for the reason `error`.
    [[noreturn]] void fail(const std::string& action, int error) const;

 private:
    void require(unsigned long request, void* argument, const std::string& action) const;
    std::string sizesOf(std::uint32_t fourcc) const;

    struct TDescriptor {
        int value{-1};
        TDescriptor() = default;
        TDescriptor(const TDescriptor&) = delete;
        TDescriptor& operator=(const TDescriptor&) = delete;
        ~TDescriptor();
    };

    std::string m_path;
    TDescriptor m_descriptor;
    v4l2_capability m_capability{};
};

}  // namespace salma::apps
