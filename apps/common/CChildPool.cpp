// SPDX-License-Identifier: BSD-3-Clause
#include "CChildPool.h"

#include <fcntl.h>
#include <linux/close_range.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace salma::apps {
namespace {

using Clock = std::chrono::steady_clock;

constexpr char kLine = 'L', kFailure = 'F', kDone = 'D';  // what a message begins with
constexpr int kPipe = STDERR_FILENO + 1;                  // where the child writes

[[noreturn]] void failOf(const std::string& what) {
    throw std::runtime_error(what + ": " + std::strerror(errno));
}

void writeAll(int descriptor, const std::string& text) {
    for (std::size_t done = 0; done < text.size();) {
        const ssize_t n = write(descriptor, text.data() + done, text.size() - done);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) failOf("pipe to the parent");
        done += static_cast<std::size_t>(n);
    }
}

void send(char kind, std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    writeAll(kPipe, kind + text + "\n");
}

/// Ends this process by SIGPROF once it has used so much processor time [s].
void limitCpu(double seconds) {
    itimerval timer{};
    timer.it_value.tv_sec = static_cast<time_t>(std::floor(seconds));
    timer.it_value.tv_usec = static_cast<suseconds_t>((seconds - std::floor(seconds)) * 1e6);
    if (timer.it_value.tv_sec == 0)
        timer.it_value.tv_usec = std::max<suseconds_t>(1, timer.it_value.tv_usec);
    std::signal(SIGPROF, SIG_DFL);
    setitimer(ITIMER_PROF, &timer, nullptr);
}

/// What the child does; never returns, so that nothing of the parent's is torn down here.
[[noreturn]] void beChild(const TChildTask& task, pid_t parent, int pipe, int prints) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);  // it died before the line above
    const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
    dup2(nothing, STDIN_FILENO);
    dup2(prints, STDOUT_FILENO);
    dup2(prints, STDERR_FILENO);
    dup2(pipe, kPipe);
    close_range(kPipe + 1, ~0U, 0);  // such as the parent's locks and other children's pipes
    if (task.cpuLimit > 0) limitCpu(task.cpuLimit);
    try {
        task.body([](const std::string& line) { send(kLine, line); });
        send(kDone, "");
    } catch (const std::exception& e) {
        send(kFailure, e.what());
    }
    _exit(0);
}

/// The last line that says something, of what the child printed.
std::string lastWords(int prints) {
    constexpr off_t kTail = 4096;
    const off_t size = lseek(prints, 0, SEEK_END);
    std::string text(static_cast<std::size_t>(std::clamp<off_t>(size, 0, kTail)), '\0');
    const ssize_t n = pread(prints, text.data(), text.size(), std::max<off_t>(0, size - kTail));
    text.resize(n < 0 ? 0 : static_cast<std::size_t>(n));
    std::istringstream lines(text);
    std::string last;
    for (std::string line; std::getline(lines, line);)
        if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
    return last;
}

std::string secondsOf(double seconds) {
    std::ostringstream text;
    text << seconds << " s";
    return text.str();
}

double secondsOf(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// A child process as its parent sees it.
class CChild {
 public:
    explicit CChild(TChildTask task) : m_task(std::move(task)) {
        std::array<int, 2> pipe{};
        if (pipe2(pipe.data(), O_CLOEXEC) != 0) failOf("cannot make a pipe");
        m_pipe = pipe[0];
        m_prints = memfd_create("output of a child", MFD_CLOEXEC);
        const pid_t parent = getpid();
        m_process = m_prints < 0 ? -1 : fork();
        if (m_process == 0) beChild(m_task, parent, pipe[1], m_prints);
        close(pipe[1]);
        if (m_process < 0) failOf("cannot start a process");
        m_start = Clock::now();
    }
    ~CChild() {
        if (m_process > 0) {
            kill(m_process, SIGKILL);
            waitpid(m_process, nullptr, 0);
        }
        close(m_pipe);
        if (m_prints >= 0) close(m_prints);
    }
    CChild(const CChild&) = delete;
    CChild& operator=(const CChild&) = delete;

    int pipe() const { return m_pipe; }

    /// Until it is killed [ms]; -1: no limit.
    int patience() const {
        if (!(m_task.wallLimit > 0) || m_late) return -1;
        const double used = std::chrono::duration<double>(Clock::now() - m_start).count();
        return static_cast<int>(std::clamp(1000 * (m_task.wallLimit - used) + 1, 0.0, 1e9));
    }

    void killIfLate() {
        if (patience() != 0) return;
        m_late = true;
        kill(m_process, SIGKILL);
    }

    /// Takes what the pipe holds; false at its end.
    bool read() {
        std::array<char, 65536> buffer{};
        const ssize_t n = ::read(m_pipe, buffer.data(), buffer.size());
        if (n < 0 && errno == EINTR) return true;
        if (n <= 0) return false;
        m_text.append(buffer.data(), static_cast<std::size_t>(n));
        std::size_t begin = 0;
        for (std::size_t end = 0; (end = m_text.find('\n', begin)) != std::string::npos;
             begin = end + 1)
            take(m_text[begin], m_text.substr(begin + 1, end - begin - 1));
        m_text.erase(0, begin);
        return true;
    }

    void finish() {
        int status = 0;
        rusage usage{};
        while (wait4(m_process, &status, 0, &usage) < 0 && errno == EINTR) {
        }
        m_process = -1;
        TChildEnd end;
        end.cpuSeconds = secondsOf(usage.ru_utime) + secondsOf(usage.ru_stime);
        if (!m_done) end.failure = m_failure ? *m_failure : deathOf(status);
        if (m_task.onEnd) m_task.onEnd(end);
    }

 private:
    void take(char kind, const std::string& text) {
        if (kind == kLine && m_task.onLine) m_task.onLine(text);
        if (kind == kFailure) m_failure = text;
        if (kind == kDone) m_done = true;
    }

    std::string deathOf(int status) const {
        if (m_late) return "no end after " + secondsOf(m_task.wallLimit);
        const bool bySignal = WIFSIGNALED(status);
        if (bySignal && WTERMSIG(status) == SIGPROF && m_task.cpuLimit > 0)
            return "more than " + secondsOf(m_task.cpuLimit) + " of processor time";
        std::string text = bySignal ? "ended by signal " + std::to_string(WTERMSIG(status)) + " (" +
                                          strsignal(WTERMSIG(status)) + ")"
                                    : "ended with exit code " + std::to_string(WEXITSTATUS(status));
        const std::string words = lastWords(m_prints);
        return words.empty() ? text : text + ": " + words;
    }

    TChildTask m_task;
    pid_t m_process{-1};
    int m_pipe{-1}, m_prints{-1};
    Clock::time_point m_start;
    bool m_late{false}, m_done{false};
    std::optional<std::string> m_failure;
    std::string m_text;  //!< Of the pipe, from the last line break on.
};

using Children = std::vector<std::unique_ptr<CChild>>;

/// Waits until a child says something, ends or is late, and deals with it.
void attend(Children& children) {
    std::vector<pollfd> pipes;
    int patience = -1;
    for (const auto& child : children) {
        pipes.push_back({child->pipe(), POLLIN, 0});
        const int mine = child->patience();
        if (mine >= 0) patience = patience < 0 ? mine : std::min(patience, mine);
    }
    if (poll(pipes.data(), pipes.size(), patience) < 0 && errno != EINTR) failOf("poll");
    for (std::size_t i = children.size(); i-- > 0;) {
        children[i]->killIfLate();
        if (pipes[i].revents == 0 || children[i]->read()) continue;
        const auto ended = std::move(children[i]);
        children.erase(children.begin() + static_cast<std::ptrdiff_t>(i));
        ended->finish();
    }
}

}  // namespace

CChildPool::CChildPool(std::size_t atOnce) : m_atOnce(std::max<std::size_t>(1, atOnce)) {}

void CChildPool::run(std::size_t count,
                     const std::function<TChildTask(std::size_t)>& taskOf) const {
    Children children;
    for (std::size_t next = 0; next < count || !children.empty();) {
        while (next < count && children.size() < m_atOnce)
            children.push_back(std::make_unique<CChild>(taskOf(next++)));
        attend(children);
    }
}

TChildEnd CChildPool::runOne(TChildTask task) {
    TChildEnd result;
    const auto onEnd = task.onEnd;
    task.onEnd = [&](const TChildEnd& end) {
        result = end;
        if (onEnd) onEnd(end);
    };
    CChildPool(1).run(1, [&](std::size_t) { return task; });
    return result;
}

}  // namespace salma::apps
