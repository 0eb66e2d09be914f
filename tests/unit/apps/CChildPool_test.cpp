// SPDX-License-Identifier: BSD-3-Clause
#include "CChildPool.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <set>
#include <stdexcept>
#include <vector>

namespace salma::apps {
namespace {

using Tell = TChildTask::Tell;

TChildEnd endOf(const std::function<void(const Tell&)>& body,
                double cpuLimit = 0,
                double wallLimit = 0) {
    TChildTask task;
    task.body = body;
    task.cpuLimit = cpuLimit;
    task.wallLimit = wallLimit;
    return CChildPool::runOne(task);
}

[[noreturn]] void burn() {
    for (volatile unsigned i = 0;; i = i + 1) {
    }
}

/// Whether a process still runs; one that nobody has waited for yet does not.
bool isAlive(pid_t process) {
    std::ifstream status("/proc/" + std::to_string(process) + "/status");
    for (std::string line; std::getline(status, line);)
        if (line.compare(0, 6, "State:") == 0) return line.find('Z') == std::string::npos;
    return false;
}

TEST(CChildPool, BringsEveryLineOfEveryTaskOnce) {
    std::multiset<std::string> lines;
    std::size_t ended = 0;
    CChildPool(3).run(20, [&](std::size_t i) {
        TChildTask task;
        task.body = [i](const Tell& tell) {
            tell("a" + std::to_string(i));
            tell("b" + std::to_string(i) + std::string(100000, 'x'));
        };
        task.onLine = [&](const std::string& line) { lines.insert(line.substr(0, 4)); };
        task.onEnd = [&](const TChildEnd& end) {
            EXPECT_EQ(end.failure, "");
            ++ended;
        };
        return task;
    });
    EXPECT_EQ(ended, 20u);
    EXPECT_EQ(lines.size(), 40u);
    for (int i = 0; i < 20; ++i) {
        EXPECT_EQ(lines.count("a" + std::to_string(i)), 1u);
        EXPECT_EQ(lines.count(("b" + std::to_string(i) + "xxx").substr(0, 4)), 1u);
    }
}

TEST(CChildPool, TellsHowAChildFailed) {
    EXPECT_EQ(endOf([](const Tell&) { throw std::runtime_error("file.ini:\n bad"); }).failure,
              "file.ini:  bad");
    EXPECT_EQ(endOf([](const Tell&) {
                  std::fprintf(stderr, "first\nlast words\n\n");
                  std::fflush(stderr);
                  raise(SIGKILL);
              }).failure,
              "ended by signal 9 (Killed): last words");
    EXPECT_EQ(endOf([](const Tell&) { _exit(7); }).failure, "ended with exit code 7");
    EXPECT_EQ(endOf([](const Tell&) { _exit(0); }).failure, "ended with exit code 0");
}

TEST(CChildPool, EndsWhatUsesTooMuchProcessorTimeOrNeverEnds) {
    EXPECT_EQ(endOf([](const Tell&) { burn(); }, 0.05).failure,
              "more than 0.05 s of processor time");
    EXPECT_EQ(endOf([](const Tell&) { pause(); }, 0, 0.05).failure, "no end after 0.05 s");
}

TEST(CChildPool, CountsTheProcessorTimeOfChildrenOfChildren) {
    const auto end = endOf([](const Tell&) { endOf([](const Tell&) { burn(); }, 0.1); });
    EXPECT_EQ(end.failure, "");
    EXPECT_GE(end.cpuSeconds, 0.05) << "the child itself needs next to nothing";
}

TEST(CChildPool, KillsItsChildrenIfACallbackThrows) {
    const auto run = [] {
        CChildPool(2).run(2, [](std::size_t i) {
            TChildTask task;
            task.body = [i](const Tell& tell) {
                tell("ready");
                if (i == 1) pause();
            };
            task.onLine = [](const std::string&) { throw std::invalid_argument("no"); };
            return task;
        });
    };
    EXPECT_THROW(run(), std::invalid_argument);
}

TEST(CChildPool, AChildDiesWithItsParent) {
    pid_t grandchild = 0;
    TChildTask task;
    task.body = [](const Tell& tell) {
        TChildTask inner;
        inner.body = [](const Tell& tellParent) {
            tellParent(std::to_string(getpid()));
            pause();
        };
        inner.onLine = [&](const std::string& line) {
            tell(line);
            raise(SIGKILL);
        };
        CChildPool::runOne(inner);
    };
    task.onLine = [&](const std::string& line) { grandchild = std::atoi(line.c_str()); };
    EXPECT_EQ(CChildPool::runOne(task).failure, "ended by signal 9 (Killed)");
    ASSERT_GT(grandchild, 0);
    for (int i = 0; i < 5000 && isAlive(grandchild); ++i) usleep(1000);
    EXPECT_FALSE(isAlive(grandchild));
}

}  // namespace
}  // namespace salma::apps
