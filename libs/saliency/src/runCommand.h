// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace salma::saliency {

struct TCommandLimits {
    double seconds{30};
    std::uint64_t fileBytes{1U << 25U};  //!< A file that the program writes; more ends it.
};

/** Runs a program to its end, in a process group of its own that is killed then.
 * \param words The program, looked up in PATH if it has no '/', and its arguments.
 * \return "" if it exited with 0, else what became of it and the first line that it said.
 * \throw std::runtime_error if it cannot be started. */
std::string runCommand(const std::vector<std::string>& words, const TCommandLimits& limits);

}  // namespace salma::saliency
