// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace salma::apps {

/// A flag for a number that is positive and finite.
inline CLI::Option* addPositive(CLI::App& command,
                                const std::string& flag,
                                double& value,
                                const std::string& meaning) {
    return command.add_option(flag, value, meaning)
        ->check([](const std::string& text) {
            double parsed = 0;
            const bool good =
                CLI::detail::lexical_cast(text, parsed) && parsed > 0 && std::isfinite(parsed);
            return good ? std::string() : "must be a number in (0, inf), not " + text;
        })
        ->capture_default_str();
}

}  // namespace salma::apps
