// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "CVideoDevice.h"

namespace salma::apps {

/** Pictures as they come from a device that was set up, in buffers that the driver fills.
 *
 * Streams from construction to destruction. */
class CVideoStream {
 public:
    struct TFrame {
        std::vector<std::uint8_t> bytes;
        double time{0};  //!< [s since 1970], of the capture where the driver tells it.
        std::uint32_t sequence{
            0};               //!< The driver's number; a gap means that pictures were dropped.
        bool damaged{false};  //!< The driver says so.
        std::string problem;  //!< Why there is no picture this time; "" if there is one.
    };

    /// `device` must outlive this object. \throw std::runtime_error
    explicit CVideoStream(CVideoDevice& device);
    ~CVideoStream();
    CVideoStream(const CVideoStream&) = delete;
    CVideoStream& operator=(const CVideoStream&) = delete;

    /** The next picture. What may be better the next time is TFrame::problem.
     * \param timeout [s] \throw std::runtime_error if nothing comes in that time; CDeviceGone */
    TFrame next(double timeout);

 private:
    struct TBuffer {
        void* start{nullptr};
        std::size_t length{0};
    };
    void map(unsigned index);
    void release();

    CVideoDevice& m_device;
    std::vector<TBuffer> m_buffers;
    bool m_streaming{false};
};

}  // namespace salma::apps
