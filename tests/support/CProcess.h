// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace salma::test {

struct TProcessResult {
    int exitCode{-1};    //!< Exit code; 128 + signal number if a signal ended it.
    std::string output;  //!< Standard output and standard error, interleaved as they came.
};

/** Runs a program to its end without a terminal and without standard input.
 * \param command Program (looked up in PATH) and its arguments; no shell is involved.
 * \throw std::runtime_error if the process cannot be started. */
TProcessResult runProcess(const std::vector<std::string>& command);

/// Path of a program of this build, e.g. program("salma-slam").
std::string program(const std::string& name);

}  // namespace salma::test
