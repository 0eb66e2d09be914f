// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>
#include <salma/slam/CSalientRBPF2D.h>

#include <memory>

#include "TStepScene.h"
#include "stepBenchmarks.h"

namespace salma::bench {
namespace {

/// A filter all of whose particles have the map of one that saw the whole scene.
class CFilledFilter {
 public:
    CFilledFilter(std::size_t particles, const TStepScene& scene)
        : m_scene(scene), m_filter(options(particles), {}) {
        slam::CSalientRBPF2D one(options(1), {});
        for (const auto& input : scene.fill()) one.process(input);
        const auto& source = one.particles().m_particles.front().d->mapTillNow;
        for (auto& particle : all().m_particles) particle.d->mapTillNow = source;
        m_filter.process(scene.toTheMiddle());
    }

    slam::CSalientRBPF2D& filter() { return m_filter; }
    const TStepScene& scene() const { return m_scene; }
    /// The filter gives its particles away for reading; a benchmark may change them.
    mrpt::maps::CMultiMetricMapPDF& all() {
        return const_cast<mrpt::maps::CMultiMetricMapPDF&>(m_filter.particles());
    }

 private:
    static slam::TRbpfOptions options(std::size_t particles) {
        slam::TRbpfOptions result;
        result.particles = static_cast<int>(particles);
        result.resampleBelow = 0;  // by itself, to be measured by itself
        return result;
    }

    TStepScene m_scene;
    slam::CSalientRBPF2D m_filter;
};

void step(benchmark::State& state, CFilledFilter& filled) {
    const auto input = filled.scene().step();
    for (auto _ : state) filled.filter().process(input);
}

void resample(benchmark::State& state, CFilledFilter& filled) {
    mrpt::bayes::CParticleFilter::TParticleFilterOptions options;
    options.resamplingMethod = mrpt::bayes::CParticleFilter::prSystematic;
    auto& particles = filled.all().m_particles;
    for (auto _ : state) {
        state.PauseTiming();
        for (std::size_t i = 0; i < particles.size(); ++i)
            particles[i].log_w = i % 2 == 0 ? 0 : -200;
        state.ResumeTiming();
        filled.all().performResampling(options);
    }
}

}  // namespace

std::string nameOfRbpfStep(const std::string& what, std::size_t particles, std::size_t landmarks) {
    return "rbpf-" + what + "/" + std::to_string(particles) + "/" + std::to_string(landmarks);
}

void registerRbpfSteps(std::size_t particles, std::size_t landmarks) {
    // Made once, though a benchmark is called several times to find the number of iterations.
    const auto filled = std::make_shared<std::unique_ptr<CFilledFilter>>();
    const auto add = [&](const std::string& what, auto function) {
        benchmark::RegisterBenchmark(nameOfRbpfStep(what, particles, landmarks).c_str(),
                                     [=](benchmark::State& state) {
                                         if (!*filled)
                                             *filled = std::make_unique<CFilledFilter>(
                                                 particles, TStepScene(landmarks));
                                         function(state, **filled);
                                     })
            ->Unit(benchmark::kMillisecond)
            ->MeasureProcessCPUTime()
            ->MinTime(0.1);
    };
    add("step", step);
    add("resample", resample);
}

}  // namespace salma::bench
