// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/system/string_utils.h>
#include <salma/config/CStrictFile.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>

namespace salma::config {
namespace {

bool isComment(const std::string& line) {
    return line.empty() || line[0] == '#' || line[0] == ';' || line.compare(0, 2, "//") == 0;
}

bool matches(const std::string& name, const std::string& pattern) {
    if (pattern.empty() || pattern.back() != '*') return name == pattern;
    return name.compare(0, pattern.size() - 1, pattern, 0, pattern.size() - 1) == 0;
}

/// Refuses what MRPT's reader would skip or let overwrite an earlier line.
class CLineCheck {
 public:
    explicit CLineCheck(const std::string& file) : m_file(file) {}

    void next(const std::string& line) {
        ++m_number;
        if (isComment(line)) return;
        if (line.find('\0') != std::string::npos) fail("is not text");
        if (line[0] == '[')
            section(line);
        else
            key(line);
    }

 private:
    void section(const std::string& line) {
        const auto end = line.find(']');
        if (end == std::string::npos) fail("section '" + line + "' lacks its ']'");
        m_section = line.substr(1, end - 1);
        if (!m_seen.insert("[" + m_section).second)
            fail("section [" + m_section + "] stands twice");
    }

    void key(const std::string& line) {
        const auto equals = line.find('=');
        if (equals == std::string::npos || equals == 0) fail("'" + line + "' is not 'key = value'");
        const std::string name = mrpt::system::trim(line.substr(0, equals));
        if (m_section.empty()) fail("key '" + name + "' stands before any section");
        if (!m_seen.insert(m_section + "]" + name).second)
            fail("[" + m_section + "] " + name + " stands twice");
    }

    [[noreturn]] void fail(const std::string& problem) const {
        throw std::invalid_argument(m_file + ":" + std::to_string(m_number) + ": " + problem);
    }

    std::string m_file;
    std::string m_section;
    std::set<std::string> m_seen;  //!< "[section" and "section]key".
    int m_number{0};
};

}  // namespace

std::unique_ptr<mrpt::config::CConfigFile> openStrict(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::invalid_argument(file + ": no such file, or not readable");
    if (!std::filesystem::is_regular_file(file))  // it is read twice
        throw std::invalid_argument(file + ": is not a regular file");
    CLineCheck check(file);
    for (std::string line; std::getline(in, line);) check.next(mrpt::system::trim(line));
    return std::make_unique<mrpt::config::CConfigFile>(file);
}

void rejectUnknownSections(const mrpt::config::CConfigFileBase& file,
                           const std::vector<std::string>& known) {
    std::vector<std::string> sections;
    file.getAllSections(sections);
    std::string unknown;
    for (const auto& name : sections)
        if (std::none_of(known.begin(), known.end(),
                         [&](const std::string& pattern) { return matches(name, pattern); }))
            unknown += " [" + name + "]";
    if (!unknown.empty())
        throw std::invalid_argument(fileName(file) + ": unknown sections:" + unknown);
}

std::string fileName(const mrpt::config::CConfigFileBase& file) {
    const auto* onDisk = dynamic_cast<const mrpt::config::CConfigFile*>(&file);
    return onDisk != nullptr ? onDisk->getAssociatedFile() : "(memory)";
}

}  // namespace salma::config
