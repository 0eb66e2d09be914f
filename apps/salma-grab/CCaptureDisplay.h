// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "CSensorThread.h"

namespace salma::apps {

/** Tells on standard error how a capture goes: one line for each sensor, redrawn on a terminal,
 * and a plain line every ten seconds elsewhere. */
class CCaptureDisplay {
 public:
    using TSensors = std::vector<std::unique_ptr<CSensorThread>>;

    CCaptureDisplay();
    /// Draws if it is time to.
    void update(const TSensors& sensors, std::uint64_t bytes);
    /// A line of its own.
    void tell(const std::string& line);
    /// The drawing stays as it is; lines come below it.
    void finish();

 private:
    using TSteady = std::chrono::steady_clock;
    struct TCount {
        TSteady::time_point time;
        std::size_t records;
    };
    /// Records a second over the last few seconds.
    double rate(const CSensorThread& sensor, std::size_t records, TSteady::time_point now);
    void draw(const std::vector<std::string>& lines);

    const bool m_terminal;
    const TSteady::time_point m_start;
    TSteady::time_point m_next;
    std::map<const CSensorThread*, std::deque<TCount>> m_counts;
    std::size_t m_drawn{0};  //!< Lines on the terminal that the next drawing replaces.
};

}  // namespace salma::apps
