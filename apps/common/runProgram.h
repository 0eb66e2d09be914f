// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

namespace salma::apps {

/** The frame that all programs share.
 *
 * Adds `--version`, starts `--help` with `examples`, parses, then calls `body`.
 * \param examples Two lines that can be copied to a shell.
 * \return 0 done; 1 `body` threw (its one-line message goes to standard error behind the program's
 * name); 2 unknown flag, missing argument or other misuse, also if `body` throws a CLI::ParseError.
 */
int runProgram(CLI::App& app,
               const std::string& examples,
               int argc,
               char** argv,
               const std::function<void()>& body);

/// The message of an exception in one line: MRPT's own carry it between a title and a call stack.
std::string oneLine(const std::string& text);

}  // namespace salma::apps
