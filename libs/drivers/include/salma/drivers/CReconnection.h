// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

namespace salma::drivers {

/// When to look for a lost device again, and what has been said about it. By the steady clock.
class CReconnection {
 public:
    /// True once the wait after the last loss is over.
    bool due() const { return Clock::now() >= m_next; }

    /** A device was lost, or not found again.
     * \param wait Until the next attempt [s].
     * \return True if that problem was not the last one: say it. */
    bool lost(const std::string& problem, double wait) {
        m_next = Clock::now() +
                 std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(wait));
        const bool fresh = problem != m_problem;
        m_problem = problem;
        return fresh;
    }

    void found() { m_problem.clear(); }

 private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point m_next;
    std::string m_problem;
};

}  // namespace salma::drivers
