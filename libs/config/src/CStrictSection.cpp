// SPDX-License-Identifier: BSD-3-Clause
#include <salma/config/CStrictFile.h>
#include <salma/config/CStrictSection.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace salma::config {

CStrictSection::CStrictSection(const mrpt::config::CConfigFileBase& file,
                               const std::string& section)
    : m_file(file), m_section(section) {}

std::string CStrictSection::where() const { return fileName(m_file) + ": [" + m_section + "]"; }

void CStrictSection::fail(const std::string& key, const std::string& problem) const {
    const std::string text = m_file.read_string(m_section, key, "");
    throw std::invalid_argument(where() + " " + key + " = '" + text + "' " + problem);
}

bool CStrictSection::has(const std::string& key) const { return m_file.keyExists(m_section, key); }

bool CStrictSection::find(const std::string& key, std::string& text) {
    m_read.insert(key);
    if (!has(key)) return false;
    text = m_file.read_string(m_section, key, "");
    if (text.compare(0, 2, "//") == 0)
        text.clear();  // MRPT takes a comment behind no value for one
    return true;
}

double CStrictSection::parseNumber(const std::string& key,
                                   const std::string& text,
                                   const TRange& range) const {
    const char* end = text.data() + text.size();
    double parsed = 0;
    const auto [last, error] = std::from_chars(text.data(), end, parsed);  // ignores the locale
    if (error != std::errc() || last != end) fail(key, "is not a number");
    if (!range.contains(parsed)) fail(key, "is outside " + range.asString());
    return parsed;
}

void CStrictSection::number(const std::string& key,
                            double& value,
                            const TRange& range,
                            const std::string&) {
    if (std::string text; find(key, text)) value = parseNumber(key, text, range);
}

void CStrictSection::integer(const std::string& key,
                             int& value,
                             const TRange& range,
                             const std::string&) {
    std::string text;
    if (!find(key, text)) return;
    const double parsed = parseNumber(key, text, range);
    if (parsed != std::floor(parsed) || !(std::abs(parsed) <= 2147483647.0))
        fail(key, "is not a whole number of 32 bits");
    value = static_cast<int>(parsed);
}

void CStrictSection::flag(const std::string& key, bool& value, const std::string&) {
    std::string text;
    if (!find(key, text)) return;
    if (text != "true" && text != "false") fail(key, "is neither true nor false");
    value = text == "true";
}

void CStrictSection::text(const std::string& key, std::string& value, const std::string&) {
    find(key, value);
}

void CStrictSection::numbers(const std::string& key,
                             std::vector<double>& values,
                             const TRange& range,
                             const std::string&) {
    std::string text;
    if (!find(key, text)) return;
    std::vector<double> parsed;
    std::istringstream in(text);
    for (std::string item; in >> item;) parsed.push_back(parseNumber(key, item, range));
    values = parsed;
}

void CStrictSection::word(const std::string& key,
                          std::size_t& index,
                          const std::vector<std::string>& words,
                          const std::string&) {
    std::string text;
    if (!find(key, text)) return;
    const auto found = std::find(words.begin(), words.end(), text);
    if (found == words.end()) {
        std::string all;
        for (const auto& w : words) all += " " + w;
        fail(key, "is not one of:" + all);
    }
    index = static_cast<std::size_t>(found - words.begin());
}

void CStrictSection::rejectUnknownKeys() const {
    std::vector<std::string> keys;
    m_file.getAllKeys(m_section, keys);
    std::string unknown;
    for (const auto& key : keys)
        if (m_read.count(key) == 0) unknown += " " + key;
    if (!unknown.empty()) throw std::invalid_argument(where() + " has unknown keys:" + unknown);
}

}  // namespace salma::config
