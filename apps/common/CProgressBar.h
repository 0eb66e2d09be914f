// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace salma::apps {

/** Tells on standard error how far a long job is.
 *
 * On a terminal one line is redrawn with the remaining time; elsewhere a plain line is printed at
 * each tenth. Silent for the first two seconds. Safe to call from several threads. */
class CProgressBar {
 public:
    CProgressBar(std::string title, std::size_t total);
    ~CProgressBar();
    CProgressBar(const CProgressBar&) = delete;
    CProgressBar& operator=(const CProgressBar&) = delete;

    void step();

 private:
    void draw(double seconds);

    const std::string m_title;
    const std::size_t m_total;
    const bool m_terminal;
    const std::chrono::steady_clock::time_point m_start;
    std::mutex m_mutex;
    std::size_t m_done{0};
    std::size_t m_shown{0};  //!< Tenths (plain) or percent (terminal) that were last printed.
    bool m_drawn{false};
};

}  // namespace salma::apps
