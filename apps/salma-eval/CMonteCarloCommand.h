// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "CMonteCarlo.h"
#include "studyTable.h"

namespace salma::apps {

/** `salma-eval montecarlo CONFIG.ini --worlds ... --out DIR`: many simulated runs and their table.
 * Adds its subcommand to an app and keeps what that was given. */
class CMonteCarloCommand {
 public:
    /// `app` may parse only while this object lives.
    explicit CMonteCarloCommand(CLI::App& app);
    CMonteCarloCommand(const CMonteCarloCommand&) = delete;
    CMonteCarloCommand& operator=(const CMonteCarloCommand&) = delete;

    bool isChosen() const { return m_command->parsed(); }

    /// Makes the runs that are missing, writes the tables and prints the main one.
    /// \throw std::exception naming file and value
    void run(std::ostream& out);

 private:
    void addOptions();
    void write(const std::vector<TRunResult>& results) const;

    CLI::App* m_command;
    TStudy m_study;
    TStudyLimits m_limits;
    std::string m_out;
};

}  // namespace salma::apps
