// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/viz/CTrajectoryScore.h>

#include <CLI/CLI.hpp>
#include <ostream>
#include <string>

#include "CMonteCarloCommand.h"
#include "CTruthMatcher.h"

namespace salma::apps {

/** salma-eval: scores of a run against the truth, as a table or as JSON.
 *
 * Adds its subcommands to `app` and keeps what they were given. */
class CEvalApp {
 public:
    /// `app` may parse only while this object lives.
    explicit CEvalApp(CLI::App& app);
    CEvalApp(const CEvalApp&) = delete;
    CEvalApp& operator=(const CEvalApp&) = delete;

    /// Does what the command line asked for. \throw std::runtime_error, std::invalid_argument
    void run(std::ostream& out);

 private:
    void addTrajectory(CLI::App& app);
    void addAssociations(CLI::App& app);
    void addOutput(CLI::App& command);
    void runTrajectory(std::ostream& out) const;
    void runAssociations(std::ostream& out) const;
    /// Prints what was asked for, and writes `name` to --out.
    void finish(std::ostream& out,
                const std::string& name,
                const std::string& table,
                const std::string& json) const;

    CMonteCarloCommand m_monteCarlo;
    CLI::App* m_trajectory{nullptr};
    CLI::App* m_associations{nullptr};
    viz::TScoreOptions m_score;
    TTruthMatcherOptions m_matcher;
    double m_maxBearingDegrees{3};
    std::string m_first, m_second;  //!< The two positional arguments of either subcommand.
    std::string m_name, m_out;
    bool m_json{false}, m_printConfig{false};
};

}  // namespace salma::apps
