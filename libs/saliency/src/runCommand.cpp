// SPDX-License-Identifier: BSD-3-Clause
#include "runCommand.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <sstream>
#include <stdexcept>

namespace salma::saliency {
namespace {

using TClock = std::chrono::steady_clock;

/// The read end does not block; both close when a program is started.
class CPipe {
 public:
    CPipe() {
        if (pipe2(m_ends.data(), O_CLOEXEC | O_NONBLOCK) != 0)
            throw std::runtime_error(std::string("a pipe: ") + std::strerror(errno));
        fcntl(m_ends[1], F_SETFL, 0);
    }
    ~CPipe() {
        closeWriteEnd();
        close(m_ends[0]);
    }
    CPipe(const CPipe&) = delete;
    CPipe& operator=(const CPipe&) = delete;
    void closeWriteEnd() {
        if (m_ends[1] >= 0) close(m_ends[1]);
        m_ends[1] = -1;
    }
    int readEnd() const { return m_ends[0]; }
    int writeEnd() const { return m_ends[1]; }

 private:
    std::array<int, 2> m_ends{};
};

/// In the child, where only system calls are allowed. Tells why on `errors` if it returns.
void become(char* const* arguments, int output, int errors, const TCommandLimits& limits) {
    const rlimit size{limits.fileBytes, limits.fileBytes}, none{0, 0};
    const int nothing = open("/dev/null", O_RDONLY);
    // Before the program runs: what it starts in turn takes over the limits that it has then.
    if (setpgid(0, 0) == 0 && setrlimit(RLIMIT_FSIZE, &size) == 0 &&
        setrlimit(RLIMIT_CORE, &none) == 0 && nothing >= 0 && dup2(nothing, STDIN_FILENO) >= 0 &&
        dup2(output, STDOUT_FILENO) >= 0 && dup2(output, STDERR_FILENO) >= 0)
        execvp(arguments[0], arguments);
    const int error = errno;
    (void)!write(errors, &error, sizeof error);
    _exit(127);
}

/// Starts a program in a process group of its own.
pid_t spawn(const std::vector<std::string>& words, int output, const TCommandLimits& limits) {
    std::vector<char*> arguments;
    for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    CPipe errors;  // a successful exec closes it
    const pid_t child = fork();
    if (child == 0) become(arguments.data(), output, errors.writeEnd(), limits);
    int error = child < 0 ? errno : 0;
    errors.closeWriteEnd();
    pollfd ended{errors.readEnd(), POLLIN, 0};
    while (child > 0 && poll(&ended, 1, -1) < 0 && errno == EINTR) {
    }
    if (child > 0 && read(errors.readEnd(), &error, sizeof error) > 0) waitpid(child, nullptr, 0);
    if (error != 0)
        throw std::runtime_error(std::string("cannot be started: ") + std::strerror(error));
    return child;
}

/// Takes what the program says, and keeps the beginning. False at its end.
bool listen(int pipe, std::string& said) {
    constexpr std::size_t kKept = 2000;
    std::array<char, 65536> buffer{};
    const ssize_t n = read(pipe, buffer.data(), buffer.size());
    if (n > 0 && said.size() < kKept)
        said.append(buffer.data(), std::min<std::size_t>(static_cast<std::size_t>(n), kKept));
    return n > 0 || (n < 0 && (errno == EAGAIN || errno == EINTR));
}

std::string firstLine(const std::string& said) {
    std::istringstream lines(said);
    for (std::string line; std::getline(lines, line);) {
        std::string text;
        for (const char c : line.substr(0, 200))
            if (c >= ' ' && c <= '~') text += c;
        if (text.find_first_not_of(' ') != std::string::npos) return ": " + text;
    }
    return "";
}

std::string verdict(int status) {
    if (WIFSIGNALED(status))
        return std::string("was ended by a signal, ") + strsignal(WTERMSIG(status));
    return "ended with exit code " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

std::string runCommand(const std::vector<std::string>& words, const TCommandLimits& limits) {
    CPipe pipe;
    const pid_t child = spawn(words, pipe.writeEnd(), limits);
    pipe.closeWriteEnd();
    const auto deadline = TClock::now() + std::chrono::duration<double>(limits.seconds);
    std::string said;
    int status = 0;
    bool speaks = true, inTime = true;
    while (waitpid(child, &status, WNOHANG) == 0) {
        if (!(TClock::now() < deadline)) {
            inTime = false;
            break;
        }
        pollfd wanted{pipe.readEnd(), POLLIN, 0};
        poll(speaks ? &wanted : nullptr, speaks ? 1 : 0, speaks ? 20 : 1);
        if (speaks) speaks = listen(pipe.readEnd(), said);
    }
    kill(-child, SIGKILL);  // also what it started and left behind
    if (!inTime) waitpid(child, &status, 0);
    if (speaks) listen(pipe.readEnd(), said);
    if (!inTime) {
        std::ostringstream text;
        text << "did not end within " << limits.seconds << " s" << firstLine(said);
        return text.str();
    }
    return status == 0 ? "" : verdict(status) + firstLine(said);
}

}  // namespace salma::saliency
