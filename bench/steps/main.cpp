// SPDX-License-Identifier: BSD-3-Clause
// Time of a filter's step and its growth, EKF beside MRPT's and RBPF, as the tables of
// docs/association.md and docs/rbpf.md.
#include <benchmark/benchmark.h>
#include <salma/viz/CGnuplot.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <limits>
#include <map>
#include <vector>

#include "stepBenchmarks.h"

namespace {

using namespace salma;

/// Google Benchmark's reporter that keeps the least processor time of each benchmark [ms].
class CTimes : public benchmark::BenchmarkReporter {
 public:
    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const auto& run : runs) {
            if (run.error_occurred) throw std::runtime_error(run.error_message);
            if (run.run_type != Run::RT_Iteration) continue;
            const double ms = 1000 * run.cpu_accumulated_time / static_cast<double>(run.iterations);
            const auto [at, isNew] = m_times.emplace(run.run_name.function_name, ms);
            if (!isNew) at->second = std::min(at->second, ms);
        }
    }
    double operator[](const std::string& name) const { return m_times.at(name); }

 private:
    std::map<std::string, double> m_times;
};

const std::vector<std::size_t> kEkfLandmarks = {30, 100, 300, 1000};
const std::vector<std::size_t> kParticles = {10, 30, 100, 300};
const std::vector<std::size_t> kRbpfLandmarks = {100, 300, 1000, 3000};

/// Power of the number with which a time grows from one row to the next.
double exponent(double time, double before, std::size_t count, std::size_t countBefore) {
    return std::log(time / before) /
           std::log(static_cast<double>(count) / static_cast<double>(countBefore));
}

void ekfTable(const CTimes& times) {
    std::printf(
        "| landmarks | block [ms] | MRPT's step [ms] | stock MRPT [ms] | stock / block | "
        "growth of block | growth of stock |\n|---|---|---|---|---|---|---|\n");
    for (std::size_t i = 0; i < kEkfLandmarks.size(); ++i) {
        const std::size_t n = kEkfLandmarks[i];
        const auto time = [&](const std::string& step, std::size_t count) {
            return times[bench::nameOfEkfStep(step, count)];
        };
        std::printf("| %zu | %.3f | %.2f | %.2f | %.0f |", n, time("block", n), time("mrpt", n),
                    time("stock", n), time("stock", n) / time("block", n));
        for (const std::string step : {"block", "stock"}) {
            if (i == 0)
                std::printf(" |");
            else
                std::printf(" n^%.1f |", exponent(time(step, n), time(step, kEkfLandmarks[i - 1]),
                                                  n, kEkfLandmarks[i - 1]));
        }
        std::printf("\n");
    }
}

void rbpfTable(const CTimes& times, const std::string& what) {
    std::printf("\nrbpf %s [ms]\n| particles |", what.c_str());
    for (const std::size_t n : kRbpfLandmarks) std::printf(" %zu landmarks |", n);
    std::printf("\n|---|---|---|---|---|\n");
    for (const std::size_t particles : kParticles) {
        std::printf("| %zu |", particles);
        for (const std::size_t n : kRbpfLandmarks)
            std::printf(" %.2f |", times[bench::nameOfRbpfStep(what, particles, n)]);
        std::printf("\n");
    }
}

void plotEkf(const CTimes& times, const std::string& file) {
    viz::CGnuplot plot(700, 420);
    std::ostream& data = plot.data("ekf");
    for (const std::size_t n : kEkfLandmarks) {
        data << n;
        for (const std::string step : {"block", "mrpt", "stock"})
            data << ' ' << times[bench::nameOfEkfStep(step, n)];
        data << '\n';
    }
    plot.endData();
    plot.script()
        << "set logscale xy\nset grid lc rgb '#dddddd'\nset border 3\nset tics nomirror\n"
           "set key top left\nset xlabel 'landmarks in the map'\n"
           "set ylabel 'time of a step with 10 measurements [ms]'\nset xrange [20:1500]\n"
           "plot $ekf using 1:2 with linespoints lw 2 pt 7 lc rgb '#1f5fa8' title 'block',"
           " $ekf using 1:3 with linespoints lw 2 pt 5 lc rgb '#888888' title "
           "'MRPT''s step, our association',"
           " $ekf using 1:4 with linespoints lw 2 pt 9 lc rgb '#c0392b' title 'stock "
           "MRPT'\n";
    plot.run(file);
}

void plotRbpf(const CTimes& times, const std::string& file) {
    viz::CGnuplot plot(1000, 420);
    std::ostream& data = plot.data("rbpf");
    for (const std::size_t n : kRbpfLandmarks) {
        data << n;
        for (const std::string what : {"step", "resample"})
            for (const std::size_t particles : kParticles)
                data << ' ' << times[bench::nameOfRbpfStep(what, particles, n)];
        data << '\n';
    }
    plot.endData();
    plot.script() << "set multiplot layout 1,2\nset logscale xy\nset grid lc rgb '#dddddd'\n"
                     "set border 3\nset tics nomirror\nset key top left\nset xrange [80:4000]\n"
                     "set xlabel 'landmarks in each map'\n";
    for (std::size_t w = 0; w < 2; ++w) {
        plot.script() << "set ylabel '" << (w == 0 ? "step with 10 measurements" : "resampling")
                      << " [ms]'\nplot ";
        for (std::size_t p = 0; p < kParticles.size(); ++p)
            plot.script() << "$rbpf using 1:" << 2 + w * kParticles.size() + p
                          << " with linespoints lw 2 pt 7 title '" << kParticles[p] << " particles'"
                          << (p + 1 < kParticles.size() ? ", " : "\n");
    }
    plot.script() << "unset multiplot\n";
    plot.run(file);
}

}  // namespace

int main(int argc, char** argv) {
    std::string ekfPlot, rbpfPlot;
    bool ekf = false, rbpf = false;
    CLI::App app("Time of a step of EKF and RBPF, and its growth");
    app.add_flag("--ekf", ekf, "the EKF's steps");
    app.add_flag("--rbpf", rbpf, "the RBPF's steps and resamplings");
    app.add_option("--ekf-plot", ekfPlot, "PNG file");
    app.add_option("--rbpf-plot", rbpfPlot, "PNG file");
    CLI11_PARSE(app, argc, argv);
    try {
        if (ekf)
            for (const std::size_t n : kEkfLandmarks) bench::registerEkfSteps(n);
        if (rbpf)
            for (const std::size_t particles : kParticles)
                for (const std::size_t n : kRbpfLandmarks) bench::registerRbpfSteps(particles, n);
        CTimes times;
        benchmark::RunSpecifiedBenchmarks(&times);
        if (ekf) ekfTable(times);
        if (rbpf) rbpfTable(times, "step");
        if (rbpf) rbpfTable(times, "resample");
        if (ekf && !ekfPlot.empty()) plotEkf(times, ekfPlot);
        if (rbpf && !rbpfPlot.empty()) plotRbpf(times, rbpfPlot);
    } catch (const std::exception& e) {
        std::cerr << "slam-steps: " << e.what() << "\n";
        return 1;
    }
}
