// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csignal>
#include <ctime>

namespace salma::test {

/// Ctrl-C and SIGTERM of an emulator's program. To be made before its threads, which inherit that
/// these signals wait.
class CEndingSignals {
 public:
    CEndingSignals() {
        sigemptyset(&m_set);
        sigaddset(&m_set, SIGINT);
        sigaddset(&m_set, SIGTERM);
        pthread_sigmask(SIG_BLOCK, &m_set, nullptr);
    }

    void wait() const {
        int signal = 0;
        sigwait(&m_set, &signal);
    }

    bool comeWithinASecond() const {
        const timespec second{1, 0};
        return sigtimedwait(&m_set, nullptr, &second) >= 0;
    }

 private:
    sigset_t m_set{};
};

}  // namespace salma::test
