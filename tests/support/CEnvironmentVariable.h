// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <optional>
#include <string>

namespace salma::test {

/// Sets a variable of this process' environment; the destructor puts the old value back.
class CEnvironmentVariable {
 public:
    CEnvironmentVariable(const std::string& name, const std::string& value) : m_name(name) {
        if (const char* old = std::getenv(name.c_str())) m_old = old;
        setenv(name.c_str(), value.c_str(), 1);
    }
    ~CEnvironmentVariable() {
        if (m_old)
            setenv(m_name.c_str(), m_old->c_str(), 1);
        else
            unsetenv(m_name.c_str());
    }
    CEnvironmentVariable(const CEnvironmentVariable&) = delete;
    CEnvironmentVariable& operator=(const CEnvironmentVariable&) = delete;

 private:
    std::string m_name;
    std::optional<std::string> m_old;
};

}  // namespace salma::test
