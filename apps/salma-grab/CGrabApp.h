// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>
#include <string>

#include "CStopSignals.h"

namespace mrpt::config {
class CConfigFile;
}

namespace salma::apps {

/** salma-grab: a capture, or the repair of one that was cut short.
 *
 * Adds its arguments to `app` and keeps what they were given. Make it before any thread. */
class CGrabApp {
 public:
    /// `app` may parse only while this object lives.
    explicit CGrabApp(CLI::App& app);
    CGrabApp(const CGrabApp&) = delete;
    CGrabApp& operator=(const CGrabApp&) = delete;

    /// Does what the command line asked for. \throw std::exception in one line
    void run(std::ostream& out);

 private:
    void loadPlugins() const;
    std::unique_ptr<mrpt::config::CConfigFile> openConfig() const;
    void printConfig(std::ostream& out) const;
    void capture(std::ostream& out);
    void repair(std::ostream& out) const;
    void repairOne(const std::string& file, const std::string& target, std::ostream& out) const;

    CStopSignals m_signals;
    std::string m_config, m_out, m_repair, m_plugins;
    double m_duration{0};
    bool m_embed{false}, m_overwrite{false}, m_printConfig{false};
};

}  // namespace salma::apps
