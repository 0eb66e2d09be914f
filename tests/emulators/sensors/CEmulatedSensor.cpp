// SPDX-License-Identifier: BSD-3-Clause
#include "CEmulatedSensor.h"

#include <mrpt/core/initializer.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/system/filesystem.h>
#include <salma/observations/CObservationPanTilt.h>
#include <salma/observations/registerClasses.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <thread>

IMPLEMENTS_GENERIC_SENSOR(CEmulatedSensor, salma::test)

namespace salma::test {
namespace {

using mrpt::obs::CObservation;
using mrpt::poses::CPose3D;

CPose3D numbered(long number) { return CPose3D(0, 0, static_cast<double>(number), 0, 0, 0); }

}  // namespace

CEmulatedSensor::~CEmulatedSensor() {
    if (m_journal != nullptr) std::fclose(m_journal);
}

void CEmulatedSensor::loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& file,
                                                const std::string& section) {
    const auto number = [&](const char* key, double standard) {
        return file.read_double(section, key, standard);
    };
    const auto at = [&](const char* key) { return static_cast<long>(number(key, -1)); };
    m_sensorLabel = section;
    m_kind = file.read_string(section, "kind", m_kind);
    m_deviceRate = number("device_rate", m_deviceRate);
    m_journalFile = file.read_string(section, "journal", "");
    m_failAt = at("fail_at");
    m_hangAt = at("hang_at");
    m_silentFrom = at("silent_from");
    m_jumpAt = at("jump_at");
    m_jump = number("jump_s", 0);
    m_blackFrom = at("black_from");
    m_smallFrom = at("small_from");
    m_failuresAtStart = static_cast<int>(number("failures_at_start", 0));
    m_width = static_cast<int>(number("width", m_width));
    m_height = static_cast<int>(number("height", m_height));
    if (!(m_deviceRate > 0)) throw std::invalid_argument("device_rate must be more than 0");
}

void CEmulatedSensor::setPathForExternalImages(const std::string& directory) {
    m_path_for_external_images = directory;
    std::filesystem::create_directories(directory);
}

void CEmulatedSensor::initialize() {
    // Failures outlive the object, for a grabber may make it anew: they are counted in a file.
    const std::string tries = m_journalFile + ".tries";
    if (m_failuresAtStart > 0) {
        const auto before = std::filesystem::exists(tries) ? std::filesystem::file_size(tries) : 0;
        if (before < static_cast<std::uintmax_t>(m_failuresAtStart)) {
            if (std::FILE* file = std::fopen(tries.c_str(), "a")) {
                std::fputc('x', file);
                std::fclose(file);
            }
            throw std::runtime_error("device is not there");
        }
    }
    if (!m_journalFile.empty()) m_journal = std::fopen(m_journalFile.c_str(), "a");
    m_start = std::chrono::steady_clock::now();
    m_startStamp = mrpt::Clock::now();
}

void CEmulatedSensor::doProcess() {
    const double elapsed =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count();
    while (static_cast<double>(m_next) / m_deviceRate <= elapsed) {
        misbehave(m_next);
        if (m_silentFrom >= 0 && m_next >= m_silentFrom) return;
        emit(m_next++);
    }
}

void CEmulatedSensor::misbehave(long number) {
    if (number == m_failAt) throw std::runtime_error("device is gone");
    while (number == m_hangAt) std::this_thread::sleep_for(std::chrono::seconds(1));
}

void CEmulatedSensor::emit(long number) {
    const auto record = make(number);
    record->sensorLabel = m_sensorLabel;
    double time = static_cast<double>(number) / m_deviceRate;
    if (m_jumpAt >= 0 && number >= m_jumpAt) time += m_jump;
    record->timestamp = m_startStamp + std::chrono::duration_cast<mrpt::Clock::duration>(
                                           std::chrono::duration<double>(time));
    if (m_journal != nullptr) {
        std::fprintf(m_journal, "%ld %.6f\n", number, mrpt::Clock::toDouble(record->timestamp));
        std::fflush(m_journal);
    }
    appendObservation(record);
}

CObservation::Ptr CEmulatedSensor::make(long number) const {
    if (m_kind == "picture") return picture(number);
    if (m_kind == "head") return head(number);
    if (m_kind == "odometry") return odometry(number);
    return scan(number);
}

CObservation::Ptr CEmulatedSensor::scan(long number) {
    constexpr std::size_t kReadings = 361;
    auto scan = mrpt::obs::CObservation2DRangeScan::Create();
    scan->aperture = static_cast<float>(M_PI);
    scan->maxRange = 32;
    scan->sensorPose = numbered(number);
    scan->resizeScan(kReadings);
    for (std::size_t i = 0; i < kReadings; ++i) {
        // Millimetres that look like noise, so that the packer has its usual work.
        auto mixed = static_cast<std::uint64_t>(number * 361 + static_cast<long>(i));
        mixed = (mixed ^ (mixed >> 7)) * 0x9E3779B97F4A7C15ULL;
        mixed = (mixed ^ (mixed >> 31)) * 0xBF58476D1CE4E5B9ULL;
        scan->setScanRange(i, 4.0F + static_cast<float>(mixed >> 57) * 0.001F);
        scan->setScanRangeValidity(i, true);
    }
    return scan;
}

CObservation::Ptr CEmulatedSensor::picture(long number) const {
    auto picture = mrpt::obs::CObservationImage::Create();
    picture->cameraPose = numbered(number);
    const bool black = m_blackFrom >= 0 && number >= m_blackFrom;
    const int shrink = m_smallFrom >= 0 && number >= m_smallFrom ? 2 : 1;
    const int width = m_width / shrink, height = m_height / shrink;
    picture->image.resize(width, height, mrpt::img::CH_GRAY);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            picture->image.at<std::uint8_t>(x, y) =
                black ? 0 : static_cast<std::uint8_t>((x * y / 16 + x + number) & 0xFF);
    if (!m_path_for_external_images.empty()) {
        const std::string name = m_sensorLabel + "_" + std::to_string(number) + ".jpg";
        picture->image.saveToFile(m_path_for_external_images + "/" + name);
        picture->image.setExternalStorage(name);
    }
    return picture;
}

CObservation::Ptr CEmulatedSensor::head(long number) {
    auto state = observations::CObservationPanTilt::Create();
    state->basePose = numbered(number);
    return state;
}

CObservation::Ptr CEmulatedSensor::odometry(long number) {
    auto reading = mrpt::obs::CObservationOdometry::Create();
    reading->odometry = mrpt::poses::CPose2D(1 + 0.01 * static_cast<double>(number), 0, 0);
    return reading;
}

}  // namespace salma::test

MRPT_INITIALIZER(registerEmulatedSensor) {
    salma::observations::registerClasses();
    salma::test::CEmulatedSensor::doRegister();
}
