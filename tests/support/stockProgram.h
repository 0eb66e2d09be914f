// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#ifndef SALMA_PRELOAD
#define SALMA_PRELOAD ""
#endif

namespace salma::test {

/** First words of a command that runs a program of MRPT with this project's plug-in.
 *
 * An instrumented plug-in needs its runtime in the process before it; what the stock program itself
 * never frees is not looked at.
 * \param options Of `env`, e.g. {"-C", folder}. */
inline std::vector<std::string> stockProgram(const std::string& name,
                                             const std::vector<std::string>& options = {}) {
    std::vector<std::string> words{"env"};
    words.insert(words.end(), options.begin(), options.end());
    if (*SALMA_PRELOAD != '\0')
        words.insert(words.end(), {"LD_PRELOAD=" SALMA_PRELOAD, "ASAN_OPTIONS=detect_leaks=0"});
    words.push_back(name);
    return words;
}

}  // namespace salma::test
