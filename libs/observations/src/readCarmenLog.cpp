// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/Clock.h>
#include <salma/observations/readCarmenLog.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "CTextLines.h"

namespace salma::observations {
namespace {

using Fields = std::vector<std::string_view>;

constexpr auto kScan = "FLASER";
constexpr std::size_t kPoseFields = 6;
constexpr std::size_t kStampFields = 3;
constexpr double kMaxReading = 1000;    // [m]
constexpr double kMaxPose = 1e6;        // [m], [rad]
constexpr double kMaxStamp = 1e10;      // [s], the year 2286
constexpr std::size_t kMaxQuoted = 40;  // characters of a bad field that are shown

Fields split(std::string_view line) {
    Fields fields;
    constexpr auto kBlanks = " \t";
    for (std::size_t at = line.find_first_not_of(kBlanks); at != std::string_view::npos;) {
        const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
        fields.push_back(line.substr(at, end - at));
        at = line.find_first_not_of(kBlanks, end);
    }
    return fields;
}

/// A field as an error shows it: printable and short.
std::string quoted(std::string_view field) {
    std::string text(field.substr(0, kMaxQuoted));
    for (char& c : text)
        if (c < ' ' || c > '~') c = '?';
    return "\"" + text + (field.size() > kMaxQuoted ? "...\"" : "\"");
}

/// Names of messages are capitals with digits, as in NMEA-GGA, or stand behind a #.
bool isMessageName(std::string_view field) {
    if (field.front() == '#') return true;
    return field.front() >= 'A' && field.front() <= 'Z' &&
           std::all_of(field.begin(), field.end(), [](char c) {
               return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
           });
}

/// Follows one log from line to line.
class CCarmenParser {
 public:
    CCarmenParser(const std::string& file, const TCarmenOptions& options)
        : m_lines(file), m_maxRange(options.maxRange) {
        m_log.file = file;
    }

    TCarmenLog run() {
        for (std::string_view line; m_lines.next(line);) {
            const Fields fields = split(line);
            if (!fields.empty()) use(fields);
        }
        if (m_log.scans.empty())
            throw std::runtime_error(m_log.file + ": holds no FLASER line; is it a CARMEN log?");
        return std::move(m_log);
    }

 private:
    void use(const Fields& fields) {
        const std::string_view name = fields.front();
        if (!isMessageName(name))
            m_lines.fail("begins with " + quoted(name) + ", which names no CARMEN message");
        if (name == kScan) return addScan(fields);
        if (name == "PARAM") noticeParameter(fields);
        ++m_log.skipped[name.front() == '#' ? "#" : std::string(name)];
    }

    void noticeParameter(const Fields& fields) {
        if (fields.size() < 3) m_lines.fail("PARAM without a value");
        if (fields[1] == "robot_frontlaser_offset")
            m_offset = number(fields, 2, -kMaxReading, kMaxReading);
        if (fields[1] == "robot_front_laser_max")
            m_maxRange = std::min(m_maxRange, number(fields, 2, 0, kMaxReading));
    }

    double number(const Fields& fields, std::size_t i, double least, double most) const {
        const std::string_view text = fields[i];
        double value = 0;
        const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
        if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size() ||
            !(value >= least && value <= most))
            m_lines.fail(std::string(fields.front()) + ": field " + std::to_string(i) + " is " +
                         quoted(text) + ", not a number from " + bound(least) + " to " +
                         bound(most));
        return value;
    }

    static std::string bound(double value) { return std::to_string(static_cast<long long>(value)); }

    /// Number of readings, held against the number of fields.
    std::size_t readings(const Fields& fields) const {
        std::size_t count = 0;
        if (fields.size() > 1) {
            const std::string_view text = fields[1];
            const auto parsed = std::from_chars(text.data(), text.data() + text.size(), count);
            if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size() || count < 2)
                m_lines.fail("FLASER: number of readings is " + quoted(text));
        }
        constexpr std::size_t kOthers = 2 + kPoseFields + kStampFields;
        if (fields.size() < kOthers || fields.size() - kOthers != count)
            m_lines.fail("FLASER of " + std::to_string(count) + " readings has " +
                         std::to_string(fields.size()) + " fields instead of " +
                         std::to_string(count + kOthers) + ": cut, or wrongly counted");
        return count;
    }

    void addScan(const Fields& fields) {
        const std::size_t n = readings(fields);
        TCarmenScan entry;
        entry.line = m_lines.number();
        entry.scan = mrpt::obs::CObservation2DRangeScan::Create();
        auto& scan = *entry.scan;
        scan.sensorLabel = kScan;
        const double step = M_PI / static_cast<double>(n % 2 == 0 ? n : n - 1);
        scan.aperture = static_cast<float>(step * static_cast<double>(n - 1));
        scan.rightToLeft = true;
        scan.maxRange = static_cast<float>(m_maxRange);
        scan.sensorPose = mrpt::poses::CPose3D(m_offset, 0, 0, n % 2 == 0 ? -step / 2 : 0.0, 0, 0);
        scan.resizeScan(n);
        for (std::size_t i = 0; i < n; ++i) {
            const double range = number(fields, 2 + i, 0, kMaxReading);
            scan.setScanRange(i, static_cast<float>(range));
            scan.setScanRangeValidity(i, range > 0 && range < m_maxRange);
        }
        const std::size_t pose = 2 + n + 3;  // behind the scanner's
        const auto value = [&](std::size_t i) { return number(fields, i, -kMaxPose, kMaxPose); };
        for (std::size_t i = pose - 3; i < pose; ++i) value(i);
        entry.odometry = mrpt::poses::CPose2D(value(pose), value(pose + 1), value(pose + 2));
        entry.time = number(fields, pose + 3, -kMaxStamp, kMaxStamp);
        number(fields, pose + 5, -kMaxStamp, kMaxStamp);
        scan.timestamp = mrpt::Clock::fromDouble(entry.time);
        if (!m_log.scans.empty() && entry.time < m_log.scans.back().time) ++m_log.backwards;
        m_log.scans.push_back(std::move(entry));
    }

    CTextLines m_lines;
    double m_maxRange;
    double m_offset{0};  //!< Of the scanner ahead of the robot's origin [m].
    TCarmenLog m_log;
};

}  // namespace

TCarmenLog readCarmenLog(const std::string& file, const TCarmenOptions& options) {
    if (!(options.maxRange > 0))
        throw std::invalid_argument("the longest range of a CARMEN log must be more than 0 m");
    return CCarmenParser(file, options).run();
}

}  // namespace salma::observations
