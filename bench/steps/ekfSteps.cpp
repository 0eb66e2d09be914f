// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/slam/CRangeBearingKFSLAM2D.h>
#include <salma/slam/CSalientEKF2D.h>

#include <memory>

#include "TStepScene.h"
#include "stepBenchmarks.h"

namespace salma::bench {
namespace {

/// MRPT's own class, driven by salma's steps.
class CStock {
 public:
    explicit CStock(const slam::TEkfOptions& /*ekf*/) {
        m_filter.setMinLoggingLevel(mrpt::system::LVL_ERROR);
        m_filter.options.std_sensor_range = 0.01F;
        m_filter.options.std_sensor_yaw = 0.001F;
    }

    void process(const slam::TStepInput& step, double reach) {
        mrpt::obs::CActionRobotMovement2D movement;
        movement.poseChange = mrpt::poses::CPosePDFGaussian::Create(step.increment);
        auto action = std::make_shared<mrpt::obs::CActionCollection>();
        action->insert(movement);
        auto record = std::make_shared<mrpt::obs::CObservationBearingRange>();
        record->maxSensorDistance = static_cast<float>(reach);
        record->fieldOfView_yaw = static_cast<float>(2 * M_PI);
        for (const auto& m : step.measurements) {
            auto& sensed = record->sensedData.emplace_back();
            sensed.range = static_cast<float>(m.z[0]);
            sensed.yaw = static_cast<float>(m.z[1]);
            sensed.pitch = 0;
            sensed.landmarkID = *m.identity;
        }
        auto frame = std::make_shared<mrpt::obs::CSensoryFrame>();
        frame->insert(record);
        m_filter.processActionObservation(action, frame);
    }

    std::size_t size() const { return m_filter.getNumberOfLandmarksInTheMap(); }

 private:
    mrpt::slam::CRangeBearingKFSLAM2D m_filter;
};

/// Salma's filter, with either step.
class COurs {
 public:
    explicit COurs(const slam::TEkfOptions& ekf) : m_filter(ekf, {}) {}
    void process(const slam::TStepInput& step, double /*reach*/) { m_filter.process(step); }
    std::size_t size() const { return m_filter.landmarks().size(); }

 private:
    slam::CSalientEKF2D m_filter;
};

/// A filter that knows all landmarks and stands among them.
template <class FILTER>
struct TFilled {
    TStepScene scene;
    FILTER filter;

    TFilled(std::size_t landmarks, const slam::TEkfOptions& options)
        : scene(landmarks), filter(options) {
        for (const auto& input : scene.fill()) filter.process(input, 0);
        filter.process(scene.toTheMiddle(), 0);
    }
};

template <class FILTER>
void add(const std::string& name, std::size_t landmarks, slam::EUpdate update) {
    slam::TEkfOptions options;
    options.update = update;
    options.maxRange = TStepScene::reach;
    // Made once, though a benchmark is called several times to find the number of iterations.
    const auto filled = std::make_shared<std::unique_ptr<TFilled<FILTER>>>();
    benchmark::RegisterBenchmark(nameOfEkfStep(name, landmarks).c_str(),
                                 [=](benchmark::State& state) {
                                     if (!*filled)
                                         *filled =
                                             std::make_unique<TFilled<FILTER>>(landmarks, options);
                                     const auto input = (*filled)->scene.step();
                                     for (auto _ : state)
                                         (*filled)->filter.process(input, TStepScene::reach);
                                     if ((*filled)->filter.size() != landmarks)
                                         state.SkipWithError("another number of landmarks");
                                 })
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->MinTime(0.3);
}

}  // namespace

std::string nameOfEkfStep(const std::string& step, std::size_t landmarks) {
    return "ekf/" + step + "/" + std::to_string(landmarks);
}

void registerEkfSteps(std::size_t landmarks) {
    add<COurs>("block", landmarks, slam::EUpdate::block);
    add<COurs>("mrpt", landmarks, slam::EUpdate::mrpt);
    add<CStock>("stock", landmarks, slam::EUpdate::mrpt);
}

}  // namespace salma::bench
