// SPDX-License-Identifier: BSD-3-Clause
#include <salma/calibration/TRangeScan.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace salma::calibration {
namespace {

constexpr std::size_t kMostRanges = 100000;

/// Takes one line apart and names it when something is wrong.
class CScanLine {
 public:
    CScanLine(std::string place, std::string_view text) : m_place(std::move(place)), m_rest(text) {}

    TRangeScan read() {
        TRangeScan scan;
        scan.time = finite("stamp");
        scan.start = finite("start");
        scan.step = finite("step");
        const double end = finite("end");
        finite("limit");
        const double count = finite("count");
        if (!(count >= 1 && count <= static_cast<double>(kMostRanges)) ||
            count != std::floor(count))
            fail("'" + std::to_string(count) + "' is no count of ranges");
        checkAngles(scan, end, count);
        while (scan.ranges.size() < static_cast<std::size_t>(count))
            scan.ranges.push_back(range(scan.ranges.size(), static_cast<std::size_t>(count)));
        if (const auto more = next(); !more.empty())
            fail("'" + std::string(more) + "' follows the " + std::to_string(scan.ranges.size()) +
                 " ranges that the line announces");
        return scan;
    }

 private:
    [[noreturn]] void fail(const std::string& problem) const {
        throw std::runtime_error(m_place + ": " + problem);
    }

    /// The next word, empty at the end of the line.
    std::string_view next() {
        constexpr std::string_view separators = " \t\r,";
        const auto from = m_rest.find_first_not_of(separators);
        if (from == std::string_view::npos) return {};
        m_rest.remove_prefix(from);
        const auto word = m_rest.substr(0, m_rest.find_first_of(separators));
        m_rest.remove_prefix(word.size());
        return word;
    }

    double number(std::string_view word, const std::string& name) const {
        double value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (error != std::errc() || end != word.data() + word.size())
            fail("'" + std::string(word) + "' is no number, where " + name + " stands");
        return value;
    }

    double finite(const std::string& name) {
        const auto word = next();
        if (word.empty()) fail("breaks off before " + name);
        const double value = number(word, name);
        if (!std::isfinite(value)) fail("'" + std::string(word) + "' is no " + name);
        return value;
    }

    double range(std::size_t index, std::size_t count) {
        const auto word = next();
        if (word.empty())
            fail("breaks off after " + std::to_string(index) + " of " + std::to_string(count) +
                 " ranges");
        const double nothing = std::numeric_limits<double>::quiet_NaN();
        if (word == "-") return nothing;
        const double value = number(word, "range " + std::to_string(index + 1));
        if (value < 0) fail("'" + std::string(word) + "' is no range");
        return std::isfinite(value) && value > 0 ? value : nothing;
    }

    void checkAngles(const TRangeScan& scan, double end, double count) const {
        if (!(std::abs(scan.step) > 1e-6) || !(std::abs(scan.step) * count < 6.5))
            fail("a step of " + std::to_string(scan.step) + " rad is none for " +
                 std::to_string(static_cast<int>(count)) + " ranges");
        const double steps = (end - scan.start) / scan.step;
        if (!(steps > count - 1.5 && steps < count + 0.5))
            fail("start, step and end make " + std::to_string(steps) + " steps for " +
                 std::to_string(static_cast<int>(count)) + " ranges");
    }

    std::string m_place;
    std::string_view m_rest;
};

}  // namespace

std::vector<TRangeScan> readScans(const std::string& file, std::size_t first, std::size_t count) {
    if (std::error_code ignored; !std::filesystem::is_regular_file(file, ignored))
        throw std::runtime_error(file + ": is missing, or not a file");
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::runtime_error(file + ": cannot be read");
    std::vector<TRangeScan> scans;
    std::size_t number = 0;
    for (std::string line; scans.size() < count && std::getline(in, line);) {
        if (++number < first) continue;
        scans.push_back(CScanLine(file + ":" + std::to_string(number), line).read());
    }
    if (scans.size() < count)
        throw std::runtime_error(file + ": has " + std::to_string(number) + " lines, but scans " +
                                 std::to_string(first) + " to " +
                                 std::to_string(first + count - 1) + " are needed");
    return scans;
}

}  // namespace salma::calibration
