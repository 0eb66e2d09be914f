// SPDX-License-Identifier: BSD-3-Clause
// MRPT's simulated range-bearing log, with its ground truth.
#include <gtest/gtest.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <salma/slam/CSalientEKF2D.h>
#include <salma/slam/rangeBearing.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace salma::slam {
namespace {

const std::string demo = "/usr/share/mrpt/datasets/kf-slam_demo";

/// Rows of numbers of a text file; lines that begin with % are comments.
std::vector<std::vector<double>> readTable(const std::string& file) {
    std::vector<std::vector<double>> rows;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::vector<double> row;
        for (double value; words >> value;) row.push_back(value);
        if (!row.empty()) rows.push_back(row);
    }
    return rows;
}

std::vector<TStepInput> readSteps() {
    mrpt::obs::CRawlog log;
    std::vector<TStepInput> steps;
    if (!log.loadFromRawLogFile(demo + ".rawlog")) return steps;
    mrpt::obs::CActionCollection::Ptr action;
    mrpt::obs::CSensoryFrame::Ptr frame;
    for (std::size_t entry = 0; entry + 1 < log.size();) {
        log.getActionObservationPair(action, frame, entry);
        TStepInput step;
        step.time = static_cast<double>(steps.size());  // the log's own stamps repeat
        step.increment.copyFrom(*action->getBestMovementEstimation()->poseChange);
        step.measurements =
            measurementsOf(*frame->getObservationByClass<mrpt::obs::CObservationBearingRange>());
        steps.push_back(step);
    }
    return steps;
}

struct TOutcome {
    std::size_t landmarks{0};
    double pathRms{0};      //!< [m]
    double landmarkRms{0};  //!< To the nearest true landmark [m].
    std::size_t deferred{0};
};

TOutcome run(const TEkfOptions& ekf, const association::TAssociationOptions& association) {
    CSalientEKF2D filter(ekf, association);
    for (const TStepInput& step : readSteps()) filter.process(step);
    TRunRecord record;
    filter.results(record);
    const auto path = readTable(demo + "_ground_truth_robot_path.txt");
    const auto map = readTable(demo + "_ground_truth.txt");
    TOutcome outcome;
    outcome.landmarks = record.landmarks.size();
    for (std::size_t i = 0; i < record.trajectory.size(); ++i)
        outcome.pathRms += std::pow(record.trajectory[i].pose.x() - path[i + 1][0], 2) +
                           std::pow(record.trajectory[i].pose.y() - path[i + 1][1], 2);
    outcome.pathRms = std::sqrt(outcome.pathRms / record.trajectory.size());
    for (const TMapLandmark& landmark : record.landmarks) {
        double nearest = 1e9;
        for (const auto& row : map)
            nearest =
                std::min(nearest, std::hypot(row[0] - landmark.mean.x, row[1] - landmark.mean.y));
        outcome.landmarkRms += nearest * nearest;
    }
    outcome.landmarkRms = std::sqrt(outcome.landmarkRms / outcome.landmarks);
    for (const auto& row : record.associations)
        outcome.deferred += row.decision == EDecision::deferred;
    return outcome;
}

class KfSlamDemo : public ::testing::Test {
 protected:
    void SetUp() override {
        if (!std::filesystem::exists(demo + ".rawlog"))
            GTEST_SKIP() << demo << ".rawlog (package mrpt-common) is missing";
    }
};

TEST_F(KfSlamDemo, MapsEveryLandmarkWhereTheLogNamesThem) {
    for (const EUpdate update : {EUpdate::block, EUpdate::mrpt}) {
        TEkfOptions ekf;
        ekf.update = update;
        const TOutcome outcome = run(ekf, {});
        EXPECT_EQ(outcome.landmarks, 70u);
        EXPECT_LE(outcome.pathRms, 0.0057);  // what MRPT's own class reaches
        EXPECT_LE(outcome.landmarkRms, 0.0042);
    }
}

TEST_F(KfSlamDemo, FindsEveryLandmarkOnceWhereIdentitiesAreIgnored) {
    TEkfOptions ekf;
    ekf.ignoreIdentities = true;
    association::TAssociationOptions association;
    for (const auto& [method, pathRms] : {std::pair(association::EMethod::nn, 0.0097),
                                          std::pair(association::EMethod::scnn, 0.0065),
                                          std::pair(association::EMethod::jcbb, 0.0065),
                                          std::pair(association::EMethod::saliency, 0.0065)}) {
        association.method = method;
        const TOutcome outcome = run(ekf, association);
        EXPECT_EQ(outcome.landmarks, 70u);
        EXPECT_LE(outcome.pathRms, pathRms);
        std::cout << "method " << static_cast<int>(method) << ": path RMS " << outcome.pathRms
                  << " m, landmark RMS " << outcome.landmarkRms << " m, deferred "
                  << outcome.deferred << std::endl;
    }
}

}  // namespace
}  // namespace salma::slam
