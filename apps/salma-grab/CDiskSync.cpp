// SPDX-License-Identifier: BSD-3-Clause
#include "CDiskSync.h"

#include <unistd.h>

#include <cerrno>

namespace salma::apps {

CDiskSync::CDiskSync(int descriptor, bool wholeFileSystem)
    : m_descriptor(descriptor), m_wholeFileSystem(wholeFileSystem), m_thread([this] { run(); }) {}

CDiskSync::~CDiskSync() {
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        m_ends = true;
    }
    m_changed.notify_all();
    m_thread.join();
}

void CDiskSync::request() {
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        m_requested = true;
    }
    m_changed.notify_all();
}

void CDiskSync::finish() {
    std::unique_lock<std::mutex> lock(m_mutex);
    m_changed.wait(lock, [this] { return !m_requested && !m_busy; });
}

void CDiskSync::run() {
    std::unique_lock<std::mutex> lock(m_mutex);
    while (true) {
        m_changed.wait(lock, [this] { return m_requested || m_ends; });
        if (!m_requested) return;
        m_requested = false;
        m_busy = true;
        lock.unlock();
        const int result = m_wholeFileSystem ? syncfs(m_descriptor) : fdatasync(m_descriptor);
        // Pipes and devices cannot be synchronised, which is no failure.
        if (result != 0 && errno != EINVAL && errno != EROFS && m_error == 0) m_error = errno;
        lock.lock();
        m_busy = false;
        m_changed.notify_all();
    }
}

}  // namespace salma::apps
