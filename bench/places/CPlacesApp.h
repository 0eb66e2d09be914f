// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/laser/CRevisitModel.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <ostream>
#include <string>

#include "realStrip.h"

namespace salma::bench {

/// Command line of the program `place-classes`.
class CPlacesApp {
 public:
    /// `app` must outlive this object.
    explicit CPlacesApp(CLI::App& app);

    /// Runs the chosen command. \throw std::runtime_error, CLI::ParseError
    void run(std::ostream& out);

 private:
    void train(std::ostream& out) const;
    void test(std::ostream& out) const;
    void walk(std::ostream& out) const;
    void strings(std::ostream& out) const;
    void revisit(std::ostream& out) const;

    CLI::App* m_train;
    CLI::App* m_test;
    CLI::App* m_walk;
    CLI::App* m_strings;
    CLI::App* m_revisit;
    CLI::App* m_strip;
    std::string m_plot;
    TStrip m_stripOptions;
    std::string m_out;
    std::string m_buildings{"test"};
    std::uint32_t m_seed{0};
    int m_count{0};
    int m_threads{0};
    double m_evidence{1};
    double m_surprise{0.3};
    laser::TRevisitOptions m_revisitOptions;
};

}  // namespace salma::bench
