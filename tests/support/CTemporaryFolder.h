// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace salma::test {

/// A fresh folder below the system's temporary folder, removed with all it holds by the destructor.
class CTemporaryFolder {
 public:
    CTemporaryFolder();
    ~CTemporaryFolder();
    CTemporaryFolder(const CTemporaryFolder&) = delete;
    CTemporaryFolder& operator=(const CTemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return m_path; }
    std::filesystem::path operator/(const std::string& name) const { return m_path / name; }

    /// Writes `text` to `name` in this folder and returns the whole path.
    std::string write(const std::string& name, const std::string& text) const;

 private:
    std::filesystem::path m_path;
};

/// Whole content of a file; a test failure and "" if it cannot be read.
std::string readFile(const std::filesystem::path& file);

/// Path below the shared data folder; empty where that folder or file is missing (use
/// SALMA_NEED_DATA).
std::string dataFile(const std::string& relative);

}  // namespace salma::test

/// Declares `variable` as the path of a file of real data, or skips the test aloud.
#define SALMA_NEED_DATA(variable, relative)                       \
    const std::string variable = salma::test::dataFile(relative); \
    if (variable.empty())                                         \
    GTEST_SKIP() << "SKIPPED, real data not here: " << SALMA_DATA_DIR << "/" << (relative)
