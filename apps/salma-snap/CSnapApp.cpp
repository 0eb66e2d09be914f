// SPDX-License-Identifier: BSD-3-Clause
#include "CSnapApp.h"

#include <pictureFault.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "videoNames.h"

namespace fs = std::filesystem;

namespace salma::apps {
namespace {

constexpr int kMostBadInARow = 25;  // a second of PAL

const std::map<std::string, EDeinterlace> kDeinterlacers = {{"auto", EDeinterlace::automatic},
                                                            {"none", EDeinterlace::none},
                                                            {"line", EDeinterlace::line},
                                                            {"blend", EDeinterlace::blend}};

std::string by(int width, int height) {
    return std::to_string(width) + " x " + std::to_string(height);
}

std::string textOf(const CVideoDevice::TFormat& format) {
    return by(format.width, format.height) + ", " + nameOfPixelFormat(format.fourcc) + ", " +
           nameOfField(format.field);
}

/// UTC with microseconds: names sort as the pictures were taken.
std::string timeName(double time) {
    const auto whole = static_cast<std::time_t>(std::floor(time));
    std::tm parts{};
    gmtime_r(&whole, &parts);
    char text[32];
    const std::size_t n = std::strftime(text, sizeof text, "%Y%m%dT%H%M%S", &parts);
    char fraction[16];
    const double rest = (time - std::floor(time)) * 1e6;
    std::snprintf(fraction, sizeof fraction, ".%06d", static_cast<int>(rest));
    return std::string(text, n) + fraction + "Z";
}

/// Appears whole or not at all.
void writeFile(const fs::path& file, const std::vector<std::uint8_t>& bytes) {
    const fs::path partial = file.string() + ".partial";
    std::ofstream out(partial, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()),
              static_cast<std::streamsize>(bytes.size()));
    out.close();
    std::error_code error;
    if (out) fs::rename(partial, file, error);
    if (out && !error) return;
    std::error_code ignored;
    fs::remove(partial, ignored);
    throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace

CSnapApp::CSnapApp(CLI::App& app) {
    app.add_option("DEVICE", m_device, "such as /dev/video0")->required();
    app.add_flag("--list", m_list, "tell what the device can do, and stop");
    app.add_option("--input", m_input, "channel, by number or name");
    app.add_option("--standard", m_standard, "PAL, NTSC, SECAM, PAL-BG, ...");
    app.add_option("--size", m_size, "WIDTHxHEIGHT");
    app.add_option("--pixel-format", m_pixelFormat,
                   "four characters; the default is the first one of --list that is understood");
    app.add_option("--deinterlace", m_deinterlace,
                   "auto, none, line (one field, lines between from it) or blend")
        ->transform(CLI::CheckedTransformer(kDeinterlacers));
    app.add_flag("--exact", m_exact, "fail where the device gives another thing than asked for");
    auto* period =
        app.add_option("--period", m_period, "continuous: seconds between pictures; 0: every one")
            ->check(CLI::NonNegativeNumber);
    auto* count = app.add_option("--count", m_count,
                                 "continuous: so many pictures; 0: until Ctrl-C or SIGTERM")
                      ->check(CLI::NonNegativeNumber);
    app.add_option("--skip", m_skip, "pictures to drop first, while the camera sets its exposure")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    app.add_option("--timeout", m_timeout, "seconds without a picture that are an error")
        ->check(CLI::Range(0.01, 3600.0))
        ->capture_default_str();
    app.add_option("--out", m_out, "folder for the pictures")->capture_default_str();
    app.add_option("--prefix", m_prefix, "begin of their names")->capture_default_str();
    app.add_option("--format", m_format, "ppm, png or jpg")
        ->check(CLI::IsMember({"ppm", "png", "jpg"}))
        ->capture_default_str();
    app.add_option("--quality", m_quality, "of jpg")
        ->check(CLI::Range(1, 100))
        ->capture_default_str();
    app.callback([this, period, count] {
        m_continuous = period->count() > 0 || count->count() > 0;
        if (m_continuous && count->count() == 0) m_count = 0;
        int used = 0;
        if (!m_size.empty() &&
            (std::sscanf(m_size.c_str(), "%dx%d%n", &m_wishedWidth, &m_wishedHeight, &used) != 2 ||
             used != static_cast<int>(m_size.size()) || m_wishedWidth < 1 || m_wishedHeight < 1))
            throw CLI::ValidationError("--size", "'" + m_size + "' is not WIDTHxHEIGHT");
    });
}

void CSnapApp::run(std::ostream& out) {
    CVideoDevice device(m_device);
    if (m_list) return list(device, out);
    if (!fs::is_directory(m_out)) throw std::runtime_error(m_out + ": no such folder");
    setUp(device, out);
    CVideoStream stream(device);
    snap(stream, out);
}

void CSnapApp::list(CVideoDevice& device, std::ostream& out) const {
    out << device.path() << ": " << device.card() << ", driver " << device.driver() << ", "
        << device.bus() << "\ninputs\n";
    const int chosen = device.input();
    for (const auto& input : device.inputs())
        out << "  " << input.index << " " << input.name << ", standards "
            << nameOfStandard(input.standards) << (input.noSignal ? ", no signal" : "")
            << (input.index == chosen ? " (chosen)" : "") << "\n";
    out << "standard\n  " << nameOfStandard(device.standard()) << "\npixel formats\n";
    for (const auto& format : device.pixelFormats())
        out << "  " << nameOfPixelFormat(format.fourcc) << " " << format.description
            << (format.sizes.empty() ? "" : ", " + format.sizes)
            << (format.converted ? ", by libv4l2" : "")
            << (canDecode(format.fourcc) ? "" : ", not understood") << "\n";
    out << "picture\n  " << textOf(device.format()) << "\n";
}

void CSnapApp::differs(const std::string& what) const {
    if (m_exact) throw std::runtime_error(m_device + ": " + what);
    std::cerr << "notice: " << what << std::endl;
}

void CSnapApp::setUp(CVideoDevice& device, std::ostream& out) {
    if (!m_input.empty()) chooseInput(device);
    if (!m_standard.empty()) chooseStandard(device);
    chooseFormat(device);
    out << "input " << device.input() << ", standard " << nameOfStandard(device.standard())
        << ", picture " << textOf(m_actual) << std::endl;
}

void CSnapApp::chooseInput(CVideoDevice& device) {
    int wished = -1;
    std::string all;
    for (const auto& input : device.inputs()) {
        if (m_input == input.name || m_input == std::to_string(input.index)) {
            wished = input.index;
            if (input.noSignal)
                std::cerr << "notice: input " << input.name << " has no signal" << std::endl;
        }
        all += " " + std::to_string(input.index) + " '" + input.name + "'";
    }
    if (wished < 0)
        throw std::runtime_error(m_device + ": has no input '" + m_input + "'; its inputs are" +
                                 (all.empty() ? " none" : all));
    device.setInput(wished);
    if (const int actual = device.input(); actual != wished)
        differs("asked for input " + std::to_string(wished) + ", the device took " +
                std::to_string(actual));
}

void CSnapApp::chooseStandard(CVideoDevice& device) {
    const std::uint64_t wished = standardOf(m_standard);
    device.setStandard(wished);
    const std::uint64_t actual = device.standard();
    if ((actual & wished) == 0 || (actual & ~wished) != 0)
        differs("asked for standard " + m_standard + ", the device took " + nameOfStandard(actual));
}

std::uint32_t CSnapApp::bestPixelFormat(CVideoDevice& device) const {
    if (!m_pixelFormat.empty()) return pixelFormatOf(m_pixelFormat);
    const auto formats = device.pixelFormats();
    for (const bool converted : {false, true})
        for (const auto& format : formats)
            if (format.converted == converted && canDecode(format.fourcc)) return format.fourcc;
    throw std::runtime_error(m_device + ": has no pixel format that is understood");
}

void CSnapApp::chooseFormat(CVideoDevice& device) {
    const auto before = device.format();
    const std::uint32_t fourcc = bestPixelFormat(device);
    const int width = m_wishedWidth > 0 ? m_wishedWidth : before.width;
    const int height = m_wishedHeight > 0 ? m_wishedHeight : before.height;
    m_actual = device.setFormat(width, height, fourcc);
    if (m_wishedWidth > 0 && (m_actual.width != width || m_actual.height != height))
        differs("asked for " + by(width, height) + ", the device gives " +
                by(m_actual.width, m_actual.height));
    if (m_actual.fourcc != fourcc)
        differs("asked for " + nameOfPixelFormat(fourcc) + ", the device gives " +
                nameOfPixelFormat(m_actual.fourcc));
    if (!canDecode(m_actual.fourcc))
        throw std::runtime_error(m_device + ": pixel format " + nameOfPixelFormat(m_actual.fourcc) +
                                 " is not understood");
}

void CSnapApp::snap(CVideoStream& stream, std::ostream& out) {
    double due = 0, time = 0;
    for (int dropped = 0; m_count == 0 || m_saved < m_count;) {
        const auto picture = nextPicture(stream, time);
        if (!picture) break;
        if (dropped++ < m_skip || time < due) continue;
        // A camera that is late does not shift the pictures that follow.
        due = due > 0 && time < due + m_period ? due + m_period : time + m_period;
        save(*picture, time, out);
    }
    if (m_continuous || m_bad > 0)
        out << "pictures saved: " << m_saved << ", frames that could not be used: " << m_bad
            << std::endl;
}

std::optional<cv::Mat> CSnapApp::nextPicture(CVideoStream& stream, double& time) {
    while (!m_signals.wait(std::chrono::milliseconds(0))) {
        const auto frame = stream.next(m_timeout);
        time = frame.time;
        try {
            if (!frame.problem.empty()) throw std::runtime_error(frame.problem);
            if (frame.damaged) throw std::runtime_error("damaged, as its driver says");
            cv::Mat picture = decodeFrame(m_actual, frame.bytes);
            m_badInARow = 0;
            return deinterlace(picture, m_actual.field, m_deinterlace);
        } catch (const std::exception& error) {
            noteBad(error.what());
        }
    }
    return std::nullopt;
}

void CSnapApp::noteBad(const std::string& problem) {
    ++m_bad;
    if (++m_badInARow == 1) std::cerr << "notice: a frame is " << problem << std::endl;
    if (m_badInARow >= kMostBadInARow)
        throw std::runtime_error(m_device + ": " + std::to_string(m_badInARow) +
                                 " frames in a row could not be used, the last one is " + problem);
}

void CSnapApp::save(const cv::Mat& picture, double time, std::ostream& out) {
    const std::string name = m_prefix + "_" + timeName(time) + "." + m_format;
    std::vector<std::uint8_t> bytes;
    std::vector<int> parameters;
    if (m_format == "jpg") parameters = {cv::IMWRITE_JPEG_QUALITY, m_quality};
    cv::Mat colour = picture;  // PPM has no grey
    if (m_format == "ppm" && picture.channels() == 1)
        cv::cvtColor(picture, colour, cv::COLOR_GRAY2BGR);
    if (!cv::imencode("." + m_format, colour, bytes, parameters))
        throw std::runtime_error(name + ": cannot be encoded");
    writeFile(fs::path(m_out) / name, bytes);
    ++m_saved;
    out << (fs::path(m_out) / name).string() << std::endl;
    warnOfContent(picture, name);
}

void CSnapApp::warnOfContent(const cv::Mat& picture, const std::string& name) const {
    cv::Mat grey = picture;
    if (picture.channels() == 3) cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
    if (const std::string fault = faultOf(grey); !fault.empty())
        std::cerr << "notice: " << name << " is " << fault << std::endl;
}

}  // namespace salma::apps
