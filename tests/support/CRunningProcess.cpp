// SPDX-License-Identifier: BSD-3-Clause
#include "CRunningProcess.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>

extern char** environ;

namespace salma::test {

CRunningProcess::CRunningProcess(const std::vector<std::string>& command) {
    std::vector<char*> arguments;
    for (const auto& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const std::string output = (m_folder / "output").string();
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(),
                                     O_WRONLY | O_CREAT | O_APPEND, 0600);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    const int error =
        posix_spawnp(&m_pid, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) throw std::runtime_error("cannot start " + command[0]);
}

CRunningProcess::~CRunningProcess() {
    if (!running()) return;
    signal(SIGKILL);
    wait();
}

void CRunningProcess::signal(int number) const {
    if (!m_ended) kill(m_pid, number);
}

bool CRunningProcess::running() {
    if (!m_ended) m_ended = waitpid(m_pid, &m_status, WNOHANG) == m_pid;
    return !m_ended;
}

TProcessResult CRunningProcess::wait() {
    if (!m_ended) waitpid(m_pid, &m_status, 0);
    m_ended = true;
    TProcessResult result;
    result.exitCode = WIFEXITED(m_status) ? WEXITSTATUS(m_status) : 128 + WTERMSIG(m_status);
    result.output = readFile(m_folder / "output");
    return result;
}

}  // namespace salma::test
