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
void checkLines(const std::string& file, std::istream& in) {
    std::string section;
    std::set<std::string> seen;
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
        const std::string place = file + ":" + std::to_string(number) + ": ";
        line = mrpt::system::trim(line);
        if (isComment(line)) continue;
        if (line.find('\0') != std::string::npos)
            throw std::invalid_argument(place + "is not text");
        if (line[0] == '[') {
            if (line.find(']') == std::string::npos)
                throw std::invalid_argument(place + "section '" + line + "' lacks its ']'");
            section = line.substr(1, line.find(']') - 1);
            if (!seen.insert("[" + section).second)
                throw std::invalid_argument(place + "section [" + section + "] stands twice");
            continue;
        }
        const auto equals = line.find('=');
        if (equals == std::string::npos || equals == 0)
            throw std::invalid_argument(place + "'" + line + "' is not 'key = value'");
        const std::string key = mrpt::system::trim(line.substr(0, equals));
        if (section.empty())
            throw std::invalid_argument(place + "key '" + key + "' stands before any section");
        if (!seen.insert(section + "]" + key).second)
            throw std::invalid_argument(place + "[" + section + "] " + key + " stands twice");
    }
}

}  // namespace

std::unique_ptr<mrpt::config::CConfigFile> openStrict(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::invalid_argument(file + ": no such file, or not readable");
    if (!std::filesystem::is_regular_file(file))  // it is read twice
        throw std::invalid_argument(file + ": is not a regular file");
    checkLines(file, in);
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
