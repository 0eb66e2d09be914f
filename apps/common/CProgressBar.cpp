// SPDX-License-Identifier: BSD-3-Clause
#include "CProgressBar.h"

#include <unistd.h>

#include <cmath>
#include <iostream>
#include <utility>

namespace salma::apps {

CProgressBar::CProgressBar(std::string title, std::size_t total)
    : m_title(std::move(title)),
      m_total(total),
      m_terminal(isatty(STDERR_FILENO) != 0),
      m_start(std::chrono::steady_clock::now()) {}

CProgressBar::~CProgressBar() {
    if (m_drawn && m_terminal) std::cerr << "\n";
}

void CProgressBar::step() {
    const std::lock_guard<std::mutex> lock(m_mutex);
    ++m_done;
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count();
    const std::size_t parts = m_terminal ? 100 : 10;
    const std::size_t shown = m_done * parts / m_total;
    if (seconds < 2 || shown == m_shown) return;
    m_shown = shown;
    draw(seconds);
}

void CProgressBar::draw(double seconds) {
    const long left =
        std::lround(seconds * static_cast<double>(m_total - m_done) / static_cast<double>(m_done));
    std::cerr << (m_terminal ? "\r" : "") << m_title << " " << m_done * 100 / m_total << " % ("
              << m_done << "/" << m_total << "), " << left << " s left"
              << (m_terminal ? "   " : "\n") << std::flush;
    m_drawn = true;
}

}  // namespace salma::apps
