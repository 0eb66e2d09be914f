// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace salma::apps {

/// How the work of a child process ended.
struct TChildEnd {
    std::string failure;   //!< "" if it was done; else what went wrong, in one line.
    double cpuSeconds{0};  //!< Processor time of the child and of its own children [s].
};

/// Work for a child process.
struct TChildTask {
    /// Sends a line of text, without line breaks, to the parent.
    using Tell = std::function<void(const std::string& line)>;

    std::function<void(const Tell& tell)> body;           //!< Runs in the child.
    std::function<void(const std::string& line)> onLine;  //!< Runs in the parent, for each line.
    std::function<void(const TChildEnd& end)> onEnd;      //!< Runs in the parent, once.
    double cpuLimit{0};   //!< Processor time of the child itself [s]; 0: none.
    double wallLimit{0};  //!< Time until it is killed, whatever it does [s]; 0: none.
};

/** Does work in child processes, so that what crashes, hangs or leaks is lost alone.
 *
 * A child is a copy of this process (fork), which must have one thread only. It has no standard
 * input, what it prints goes nowhere, and it dies with its parent. A body that throws, ends by a
 * signal, by exit() or by a limit has failed. Bodies may use a pool of their own. */
class CChildPool {
 public:
    /// \param atOnce Children that live at one time, at least 1.
    explicit CChildPool(std::size_t atOnce);

    /** Does tasks 0 ... count - 1, begun in this order.
     * \param taskOf Called in the parent when a child becomes free for task i.
     * \throw std::runtime_error if no process can be made; what a callback throws. In both cases
     * all children are killed first. */
    void run(std::size_t count, const std::function<TChildTask(std::size_t)>& taskOf) const;

    /// Does one task and waits for it.
    static TChildEnd runOne(TChildTask task);

 private:
    std::size_t m_atOnce;
};

}  // namespace salma::apps
