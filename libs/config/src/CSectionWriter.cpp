// SPDX-License-Identifier: BSD-3-Clause
#include <salma/config/CSectionWriter.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iomanip>

namespace salma::config {
namespace {

/// Fewest digits that come within a billionth of the value, without exponent where that reads well.
std::string shortest(double value) {
    char text[64];
    for (int digits = 1; digits <= 12; ++digits) {
        std::snprintf(text, sizeof text, "%.*g", digits, value);
        if (std::abs(std::strtod(text, nullptr) - value) <= 1e-9 * std::abs(value)) break;
    }
    const double rounded = std::strtod(text, nullptr);
    if (std::strchr(text, 'e') != nullptr && rounded == std::floor(rounded) &&
        std::abs(rounded) < 1e9)
        std::snprintf(text, sizeof text, "%.0f", rounded);
    return text;
}

}  // namespace

CSectionWriter::CSectionWriter(std::ostream& out, const std::string& section) : m_out(out) {
    m_out << "[" << section << "]\n";
}

void CSectionWriter::line(const std::string& key,
                          const std::string& value,
                          const std::string& comment) {
    m_out << std::left << std::setw(24) << key << " = " << std::setw(12) << value << "  // "
          << comment << "\n";
}

void CSectionWriter::number(const std::string& key,
                            double& value,
                            const TRange& range,
                            const std::string& meaning) {
    line(key, shortest(value), meaning + ", " + range.asString());
}

void CSectionWriter::integer(const std::string& key,
                             int& value,
                             const TRange& range,
                             const std::string& meaning) {
    line(key, std::to_string(value), meaning + ", " + range.asString());
}

void CSectionWriter::flag(const std::string& key, bool& value, const std::string& meaning) {
    line(key, value ? "true" : "false", meaning + ", true or false");
}

void CSectionWriter::text(const std::string& key, std::string& value, const std::string& meaning) {
    line(key, value, meaning);
}

void CSectionWriter::numbers(const std::string& key,
                             std::vector<double>& values,
                             const TRange& range,
                             const std::string& meaning) {
    std::string all;
    for (const double v : values) all += (all.empty() ? "" : " ") + shortest(v);
    line(key, all, meaning + ", each in " + range.asString());
}

void CSectionWriter::word(const std::string& key,
                          std::size_t& index,
                          const std::vector<std::string>& words,
                          const std::string& meaning) {
    std::string all;
    for (const auto& w : words) all += (all.empty() ? "" : " | ") + w;
    line(key, words[index], meaning + ", " + all);
}

}  // namespace salma::config
