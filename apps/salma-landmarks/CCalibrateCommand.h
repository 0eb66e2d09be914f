// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "TCalibrationOptions.h"

namespace salma::apps {

/** `salma-landmarks calibrate TRUTH_DIR... --out DIR`: learns what the scores of two patches are
 * worth from simulated runs. Adds its subcommand to an app and keeps what that was given. */
class CCalibrateCommand {
 public:
    /// `app` may parse only while this object lives.
    explicit CCalibrateCommand(CLI::App& app);
    CCalibrateCommand(const CCalibrateCommand&) = delete;
    CCalibrateCommand& operator=(const CCalibrateCommand&) = delete;

    bool isChosen() const { return m_command->parsed(); }

    /** Writes all files or none, and prints the figures.
     * \throw std::invalid_argument, std::runtime_error naming the file at fault; CLI::ParseError */
    void run(std::ostream& out);

 private:
    void addOptions();

    CLI::App* m_command;
    TCalibrationOptions m_options;
    std::vector<std::string> m_learning, m_report;
    std::string m_configFile, m_out;
    bool m_printConfig{false};
};

}  // namespace salma::apps
