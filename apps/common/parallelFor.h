// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

namespace salma::apps {

/** Calls body(0) ... body(count - 1), each once, from several threads.
 * \param threads 0: one per core.
 * If calls throw, the exception of the smallest index among those that ran is rethrown at the end
 * and no new calls are begun. */
void parallelFor(std::size_t count, int threads, const std::function<void(std::size_t)>& body);

}  // namespace salma::apps
