// SPDX-License-Identifier: BSD-3-Clause
#include "parallelFor.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace salma::apps {
namespace {

TEST(ParallelFor, CallsEveryIndexOnceForAnyNumberOfThreads) {
    for (const int threads : {0, 1, 2, 3, 8, 300})
        for (const std::size_t count : {1U, 2U, 7U, 200U}) {
            std::vector<std::atomic<int>> calls(count);
            parallelFor(count, threads, [&](std::size_t i) { ++calls.at(i); });
            for (std::size_t i = 0; i < count; ++i)
                ASSERT_EQ(calls[i], 1) << i << " of " << count << " by " << threads;
        }
}

TEST(ParallelFor, CallsNothingForACountOfZero) {
    for (const int threads : {0, 1, 4})
        parallelFor(0, threads, [](std::size_t i) { ADD_FAILURE() << "called for " << i; });
}

TEST(ParallelFor, WorksInSeveralThreadsAtOnce) {
    // neither call can end before the other has begun
    std::atomic<int> begun{0};
    parallelFor(2, 2, [&](std::size_t) {
        ++begun;
        while (begun < 2) std::this_thread::yield();
    });
    EXPECT_EQ(begun, 2);
}

/// What parallelFor throws if the calls from `firstBad` on throw their index.
std::string errorOf(int threads, std::size_t firstBad) {
    try {
        parallelFor(50, threads, [&](std::size_t i) {
            if (i >= firstBad) throw std::runtime_error(std::to_string(i));
        });
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "none";
}

TEST(ParallelFor, RethrowsTheExceptionOfTheSmallestIndex) {
    for (int repetition = 0; repetition < 20; ++repetition)
        for (const int threads : {0, 1, 2, 5}) {
            EXPECT_EQ(errorOf(threads, 0), "0");
            EXPECT_EQ(errorOf(threads, 31), "31");
            EXPECT_EQ(errorOf(threads, 49), "49");
            EXPECT_EQ(errorOf(threads, 50), "none");
        }
}

TEST(ParallelFor, RethrowsTheSmallestIndexAlsoIfALargerOneFailedEarlier) {
    for (int repetition = 0; repetition < 20; ++repetition) {
        std::atomic<bool> laterFails{false};
        try {
            parallelFor(2, 2, [&](std::size_t i) {
                if (i == 1) laterFails = true;
                while (!laterFails) std::this_thread::yield();
                throw std::runtime_error(std::to_string(i));
            });
            FAIL() << "nothing was thrown";
        } catch (const std::runtime_error& e) {
            EXPECT_STREQ(e.what(), "0");
        }
    }
}

TEST(ParallelFor, BeginsNoCallsAfterAFailure) {
    std::vector<std::size_t> called;
    EXPECT_THROW(parallelFor(9, 1,
                             [&](std::size_t i) {
                                 called.push_back(i);
                                 if (i == 3) throw std::runtime_error("");
                             }),
                 std::runtime_error);
    EXPECT_EQ(called, (std::vector<std::size_t>{0, 1, 2, 3}));
}

}  // namespace
}  // namespace salma::apps
