// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "CRepeatabilityBench.h"

namespace salma::bench {

/// Command line and files of the program `region-repeatability`.
class CRepeatabilityApp {
 public:
    /// `app` must outlive this object.
    explicit CRepeatabilityApp(CLI::App& app);

    /** Writes repeatability.csv and .md, SET.png, sets.png and regions/ to the folder of --out.
     * \param out Gets a line for each set. \throw std::runtime_error, CLI::ParseError */
    void run(std::ostream& out);

 private:
    std::vector<std::string> m_folders;
    std::string m_out;
    TBenchOptions m_options;
};

}  // namespace salma::bench
