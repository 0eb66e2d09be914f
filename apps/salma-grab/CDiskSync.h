// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace salma::apps {

/** Asks the system, in a thread of its own, to put what a file holds on the disk. */
class CDiskSync {
 public:
    /// \param wholeFileSystem syncfs() instead of fdatasync(): also all other files beside it.
    CDiskSync(int descriptor, bool wholeFileSystem);
    ~CDiskSync();
    CDiskSync(const CDiskSync&) = delete;
    CDiskSync& operator=(const CDiskSync&) = delete;

    /// Soon; requests that come while one is served become one.
    void request();
    /// Waits until all requests are served.
    void finish();
    /// errno of the first failure; 0 for none.
    int error() const { return m_error; }

 private:
    void run();

    const int m_descriptor;
    const bool m_wholeFileSystem;
    std::mutex m_mutex;
    std::condition_variable m_changed;
    bool m_requested{false}, m_busy{false}, m_ends{false};
    std::atomic<int> m_error{0};
    std::thread m_thread;  //!< Last: it uses all others.
};

}  // namespace salma::apps
