// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/appearance/CPictureMatcher.h>

#include <CLI/CLI.hpp>
#include <ostream>
#include <string>

namespace salma::apps {

/** `salma-features match A B --out DIR`: whether two pictures show the same plane, with a table
 * MATCHES.csv and a picture OVERLAY.png of the agreeing pairs. Adds its subcommand to an app and
 * keeps what that was given. */
class CMatchCommand {
 public:
    /// `app` may parse only while this object lives.
    explicit CMatchCommand(CLI::App& app);
    CMatchCommand(const CMatchCommand&) = delete;
    CMatchCommand& operator=(const CMatchCommand&) = delete;

    bool isChosen() const { return m_command->parsed(); }

    /** Writes both files or none; its last line to `out` is
     * "score S log_lr L decision same|other|unknown".
     * \throw std::invalid_argument, std::runtime_error naming the file at fault. */
    void run(std::ostream& out);

 private:
    /// What CLI11 does not check itself. \throw CLI::ParseError
    void checkUsage() const;

    CLI::App* m_command;
    appearance::TPictureMatcherOptions m_options;
    std::string m_first;
    std::string m_second;
    std::string m_out;
    std::string m_configFile;
    bool m_printConfig{false};
};

}  // namespace salma::apps
