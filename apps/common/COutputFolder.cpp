// SPDX-License-Identifier: BSD-3-Clause
#include "COutputFolder.h"

#include <unistd.h>

#include <fstream>
#include <stdexcept>
#include <system_error>

namespace fs = std::filesystem;

namespace salma::apps {
namespace {

constexpr auto kMarker = ".salma-output";  // tells our folders from a user's

[[noreturn]] void fail(const fs::path& folder, const std::string& problem) {
    throw std::runtime_error(folder.string() + ": " + problem);
}

}  // namespace

COutputFolder::COutputFolder(const fs::path& target)
    : m_target(fs::absolute(target).lexically_normal()) {
    if (!m_target.has_filename()) m_target = m_target.parent_path();  // "DIR/"
    std::error_code error;
    if (fs::exists(m_target, error)) {
        if (!fs::is_directory(m_target)) fail(m_target, "exists and is not a folder");
        if (!fs::is_empty(m_target) && !fs::exists(m_target / kMarker))
            fail(m_target,
                 "exists, is not empty and was not written by salma: name another folder");
    }
    m_staging = m_target.string() + ".partial-" + std::to_string(getpid());
    fs::remove_all(m_staging, error);  // of a killed process that had our number
    fs::create_directories(m_staging, error);
    if (error) fail(m_target, "cannot write there: " + error.message());
    std::ofstream(m_staging / kMarker) << "Results of salma. A new run replaces this folder.\n";
}

COutputFolder::~COutputFolder() {
    std::error_code ignored;
    fs::remove_all(m_staging, ignored);
}

void COutputFolder::write(const std::string& name, const std::string& content) const {
    std::ofstream out(m_staging / name, std::ios::binary);
    out << content;
    out.close();
    if (!out) fail(m_target / name, "cannot be written");
}

void COutputFolder::publish() {
    std::error_code error;
    const fs::path old = m_staging.string() + ".old";
    const bool replaces = fs::exists(m_target);
    if (replaces) fs::rename(m_target, old, error);
    if (!error) fs::rename(m_staging, m_target, error);
    if (error) {
        std::error_code ignored;
        if (replaces && !fs::exists(m_target)) fs::rename(old, m_target, ignored);
        fail(m_target, "cannot be replaced: " + error.message());
    }
    fs::remove_all(old, error);
}

void COutputFolder::publishInto() {
    std::error_code error;
    fs::create_directories(m_target, error);
    for (const auto& entry : fs::directory_iterator(m_staging)) {
        const fs::path place = m_target / entry.path().filename();
        if (!error && entry.is_directory()) fs::remove_all(place, error);
        if (!error) fs::rename(entry.path(), place, error);
    }
    if (error) fail(m_target, "cannot be written: " + error.message());
}

}  // namespace salma::apps
