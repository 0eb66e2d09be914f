// SPDX-License-Identifier: BSD-3-Clause
#include "CResultFile.h"

#include <fcntl.h>
#include <mrpt/system/md5.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace salma::apps {
namespace {

using nlohmann::ordered_json;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& problem) {
    throw std::runtime_error(file.string() + ": " + problem);
}

std::string contentOf(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    if (!in) fail(file, "cannot be read");
    return text;
}

std::string dump(const ordered_json& json) {  // messages need not be UTF-8
    return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

// NaN is null in JSON.
void fromJson(const ordered_json& json, double& value) {
    value = json.is_null() ? TRunScore::kNone : json.get<double>();
}
void fromJson(const ordered_json& json, std::vector<double>& values) {
    values.assign(json.size(), 0);
    for (std::size_t i = 0; i < values.size(); ++i) fromJson(json[i], values[i]);
}
template <class VALUE>
void fromJson(const ordered_json& json, VALUE& value) {
    json.get_to(value);
}

}  // namespace

std::string asLine(const TRunResult& result) {
    ordered_json json;
    TRunResult::forEach(result,
                        [&](const std::string& name, const auto& value) { json[name] = value; });
    const std::string text = dump(json);
    return "{\"md5\":\"" + md5Of(text) + "\",\"result\":" + text + "}";
}

TRunResult resultOf(const std::string& line) {
    TRunResult result;
    std::size_t fields = 0;
    try {
        const auto json = ordered_json::parse(line);
        const auto& values = json.at("result");
        if (json.at("md5").get<std::string>() != md5Of(dump(values)))
            throw std::invalid_argument("the check sum differs: the line was changed");
        TRunResult::forEach(result, [&](const std::string& name, auto& value) {
            fromJson(values.at(name), value);
            ++fields;
        });
        if (values.size() != fields) throw std::invalid_argument("holds a key that is not known");
    } catch (const nlohmann::json::exception& e) {
        throw std::invalid_argument(std::string("is no result: ") + e.what());
    }
    return result;
}

CResultFile::CResultFile(const std::filesystem::path& file) : m_file(file) {
    m_descriptor = open(file.c_str(), O_CREAT | O_RDWR | O_APPEND | O_CLOEXEC, 0666);
    if (m_descriptor < 0) fail(file, std::string("cannot be opened: ") + std::strerror(errno));
    try {
        if (flock(m_descriptor, LOCK_EX | LOCK_NB) != 0)
            fail(file, "another program works on this study");
        const std::string text = contentOf(file);
        const std::size_t whole = text.rfind('\n') + 1;  // npos + 1 is 0
        if (whole < text.size() && ftruncate(m_descriptor, static_cast<off_t>(whole)) != 0)
            fail(file, std::string("cannot be written: ") + std::strerror(errno));
        readLines(text.substr(0, whole));
    } catch (...) {
        close(m_descriptor);
        throw;
    }
}

CResultFile::~CResultFile() { close(m_descriptor); }

void CResultFile::readLines(const std::string& text) {
    std::size_t number = 1;
    for (std::size_t begin = 0; begin < text.size(); ++number) {
        const std::size_t end = text.find('\n', begin);
        try {
            m_results.push_back(resultOf(text.substr(begin, end - begin)));
        } catch (const std::invalid_argument& e) {
            throw std::runtime_error(m_file.string() + ":" + std::to_string(number) + ": " +
                                     e.what() + "; without the line the run is made again");
        }
        begin = end + 1;
    }
}

void CResultFile::add(const TRunResult& result) {
    const std::string line = asLine(result) + "\n";
    const ssize_t n = write(m_descriptor, line.data(), line.size());
    if (n != static_cast<ssize_t>(line.size()) || fdatasync(m_descriptor) != 0)
        fail(m_file, std::string("cannot be written: ") + std::strerror(errno));
    m_results.push_back(result);
}

std::string md5Of(const std::string& text) { return mrpt::system::md5(text); }

std::string md5OfFile(const std::filesystem::path& file) { return md5Of(contentOf(file)); }

}  // namespace salma::apps
