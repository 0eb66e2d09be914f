// SPDX-License-Identifier: BSD-3-Clause
#include "CTemporaryFolder.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace salma::test {

CTemporaryFolder::CTemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "salma-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make folder " + name);
    m_path = name;
}

CTemporaryFolder::~CTemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(m_path, ignored);
}

std::string CTemporaryFolder::write(const std::string& name, const std::string& text) const {
    const auto file = m_path / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file.string();
}

std::string readFile(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    EXPECT_TRUE(in) << "cannot read " << file;
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

std::string dataFile(const std::string& relative) {
    const auto file = std::filesystem::path(SALMA_DATA_DIR) / relative;
    return std::filesystem::exists(file) ? file.string() : "";
}

}  // namespace salma::test
