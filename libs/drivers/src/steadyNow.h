// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace salma::drivers {

/// Seconds of a clock that nobody sets.
inline double steadyNow() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

}  // namespace salma::drivers
