// SPDX-License-Identifier: BSD-3-Clause
#include "CPictureFolder.h"

#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

namespace salma::test {

CPictureFolder::CPictureFolder(const std::filesystem::path& folder,
                               std::function<void(std::size_t)> looked)
    : m_looked(std::move(looked)), m_events(inotify_init1(IN_CLOEXEC | IN_NONBLOCK)) {
    if (m_events < 0 || inotify_add_watch(m_events, folder.c_str(), IN_OPEN) < 0)
        throw std::runtime_error(folder.string() + ": cannot be watched");
    m_thread = std::thread([this] { watch(); });
}

CPictureFolder::~CPictureFolder() {
    m_stop = true;
    m_thread.join();
    close(m_events);
}

std::string CPictureFolder::name(std::size_t index) {
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "%04zu.png", index);
    return text.data();
}

void CPictureFolder::watch() {
    alignas(inotify_event) std::array<char, 4096> buffer{};
    while (!m_stop) {
        pollfd entry{m_events, POLLIN, 0};
        if (poll(&entry, 1, 50) <= 0) continue;
        const ssize_t n = read(m_events, buffer.data(), buffer.size());
        for (ssize_t at = 0; at < n;) {
            const auto* event = reinterpret_cast<const inotify_event*>(buffer.data() + at);
            char* end = nullptr;
            const auto index = event->len > 0 ? std::strtoul(event->name, &end, 10) : 0;
            if (event->len > 0 && end != event->name) m_looked(index);
            at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
        }
    }
}

}  // namespace salma::test
