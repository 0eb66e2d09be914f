// SPDX-License-Identifier: BSD-3-Clause
#include "CStopSignals.h"

#include <pthread.h>

#include <ctime>

namespace salma::apps {

CStopSignals::CStopSignals() {
    sigemptyset(&m_set);
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&m_set, number);
    pthread_sigmask(SIG_BLOCK, &m_set, nullptr);
    for (const int number : {SIGPIPE, SIGXFSZ}) std::signal(number, SIG_IGN);
}

std::optional<std::string> CStopSignals::wait(std::chrono::milliseconds time) {
    const auto whole = std::chrono::duration_cast<std::chrono::seconds>(time);
    const std::chrono::nanoseconds rest = time - whole;
    timespec limit{};
    limit.tv_sec = whole.count();
    limit.tv_nsec = rest.count();
    switch (sigtimedwait(&m_set, nullptr, &limit)) {
        case SIGINT:
            return "SIGINT";
        case SIGTERM:
            return "SIGTERM";
        case SIGHUP:
            return "SIGHUP";
        default:
            return std::nullopt;
    }
}

}  // namespace salma::apps
