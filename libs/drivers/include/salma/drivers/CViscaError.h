// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace salma::drivers {

/// A VISCA camera refused, gave up, or does not answer; what() names port and camera.
class CViscaError : public std::runtime_error {
 public:
    CViscaError(const std::string& what, int code) : std::runtime_error(what), m_code(code) {}

    /// As the camera sent it (02, 03, 04, 05, 41, each hexadecimal); 0: it said nothing.
    int code() const { return m_code; }

 private:
    int m_code;
};

}  // namespace salma::drivers
