// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <csignal>
#include <optional>
#include <string>

namespace salma::apps {

/** Ctrl-C, SIGTERM and SIGHUP as events of the main loop.
 *
 * Must be made before the first thread, for threads inherit that these signals wait. Also turns off
 * the signals by which a closed pipe and a file-size limit would end the program. */
class CStopSignals {
 public:
    CStopSignals();

    /// Name of the signal that came within `time`, or was waiting; nothing if none came.
    std::optional<std::string> wait(std::chrono::milliseconds time);

 private:
    sigset_t m_set{};
};

}  // namespace salma::apps
