// SPDX-License-Identifier: BSD-3-Clause
#include "parallelFor.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace salma::apps {

void parallelFor(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
    std::atomic<std::size_t> next{0};
    std::atomic<bool> failed{false};
    std::mutex mutex;
    std::size_t firstBad = count;
    std::exception_ptr error;
    const auto work = [&] {
        for (std::size_t i = 0; !failed && (i = next++) < count;) try {
                body(i);
            } catch (...) {
                const std::lock_guard<std::mutex> lock(mutex);
                if (i < firstBad) {
                    firstBad = i;
                    error = std::current_exception();
                }
                failed = true;
            }
    };
    const std::size_t wanted = threads > 0 ? static_cast<std::size_t>(threads)
                                           : std::max(1U, std::thread::hardware_concurrency());
    std::vector<std::thread> pool;
    for (std::size_t t = 1; t < std::min(wanted, count); ++t) pool.emplace_back(work);
    work();
    for (auto& thread : pool) thread.join();
    if (error) std::rethrow_exception(error);
}

}  // namespace salma::apps
