// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <ostream>
#include <string>

#include "CStopSignals.h"
#include "CVideoDevice.h"
#include "CVideoStream.h"
#include "decodeFrame.h"

namespace salma::apps {

/** salma-snap: single pictures, or one every so often, from a V4L2 device, after Ho's account of
 * his systems (2004, appendix A): capabilities, input channel, size and format set and read back.
 *
 * Adds its arguments to `app` and keeps what they were given. Make it before any thread. */
class CSnapApp {
 public:
    /// `app` may parse only while this object lives.
    explicit CSnapApp(CLI::App& app);
    CSnapApp(const CSnapApp&) = delete;
    CSnapApp& operator=(const CSnapApp&) = delete;

    /// Does what the command line asked for. \throw std::exception in one line
    void run(std::ostream& out);

 private:
    void list(CVideoDevice& device, std::ostream& out) const;
    void setUp(CVideoDevice& device, std::ostream& out);
    void chooseInput(CVideoDevice& device);
    void chooseStandard(CVideoDevice& device);
    void chooseFormat(CVideoDevice& device);
    std::uint32_t bestPixelFormat(CVideoDevice& device) const;
    /// Tells a difference between wish and reality; throws with --exact.
    void differs(const std::string& what) const;

    void snap(CVideoStream& stream, std::ostream& out);
    /// The next picture that is whole, or nothing once a signal came.
    std::optional<cv::Mat> nextPicture(CVideoStream& stream, double& time);
    /// Counts it; throws when too many followed one another.
    void noteBad(const std::string& problem);
    void save(const cv::Mat& picture, double time, std::ostream& out);
    void warnOfContent(const cv::Mat& picture, const std::string& name) const;

    CStopSignals m_signals;
    std::string m_device, m_input, m_standard, m_size, m_pixelFormat, m_out{"."}, m_prefix{"snap"};
    std::string m_format{"png"};
    EDeinterlace m_deinterlace{EDeinterlace::automatic};
    double m_period{0}, m_timeout{2};
    int m_count{1}, m_skip{4}, m_quality{95}, m_wishedWidth{0}, m_wishedHeight{0};
    bool m_list{false}, m_exact{false}, m_continuous{false};

    CVideoDevice::TFormat m_actual;
    int m_saved{0}, m_bad{0}, m_badInARow{0};
};

}  // namespace salma::apps
