// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "CProcess.h"
#include "CTemporaryFolder.h"

namespace salma::test {

/// A program that runs beside the test, without standard input; killed by the destructor if it
/// still runs.
class CRunningProcess {
 public:
    /// \param command As of runProcess(). \throw std::runtime_error if it cannot be started.
    explicit CRunningProcess(const std::vector<std::string>& command);
    ~CRunningProcess();
    CRunningProcess(const CRunningProcess&) = delete;
    CRunningProcess& operator=(const CRunningProcess&) = delete;

    void signal(int number) const;
    bool running();
    /// Waits for its end.
    TProcessResult wait();

 private:
    CTemporaryFolder m_folder;
    pid_t m_pid{-1};
    bool m_ended{false};
    int m_status{0};
};

}  // namespace salma::test
