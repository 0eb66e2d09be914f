// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <optional>
#include <string>

namespace salma::bench {

/// What a benchmark gave: its shortest repetition, and its number of regions.
struct TTime {
    double seconds{0};
    std::size_t regions{0};
};

/// Google Benchmark's reporter that keeps the shortest time of each benchmark.
class CTimes : public benchmark::BenchmarkReporter {
 public:
    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>& runs) override;

    /// Of the benchmark of this name, if it was run.
    std::optional<TTime> find(const std::string& name) const;

 private:
    std::map<std::string, TTime> m_times;
};

}  // namespace salma::bench
