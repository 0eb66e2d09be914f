// SPDX-License-Identifier: BSD-3-Clause
#include "stockRun.h"

#include <mrpt/config/CConfigFile.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/slam/CRangeBearingKFSLAM.h>
#include <mrpt/slam/CRangeBearingKFSLAM2D.h>

#include <ctime>
#include <filesystem>
#include <stdexcept>

namespace salma::bench {
namespace {

using mrpt::math::TPoint3D;

double processorTime() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

TPoint3D positionOf(const mrpt::slam::CRangeBearingKFSLAM2D& filter) {
    mrpt::poses::CPosePDFGaussian pose;
    filter.getCurrentRobotPose(pose);
    return {pose.mean.x(), pose.mean.y(), 0};
}

TPoint3D positionOf(const mrpt::slam::CRangeBearingKFSLAM& filter) {
    const auto pose = filter.getCurrentRobotPoseMean();
    return {pose.x(), pose.y(), pose.z()};
}

template <class FILTER>
std::vector<TPoint3D> landmarksOf(FILTER& filter) {
    std::vector<TPoint3D> result;
    for (std::size_t k = 0; k < filter.getNumberOfLandmarksInTheMap(); ++k) {
        typename FILTER::KFArray_FEAT mean;
        filter.getLandmarkMean(k, mean);
        result.emplace_back(mean[0], mean[1], mean.size() > 2 ? mean[mean.size() - 1] : 0.0);
    }
    return result;
}

template <class FILTER>
TDemoRun run(const TDemo& demo, const std::string& ini, EStockMethod method) {
    mrpt::obs::CRawlog log;
    if (!std::filesystem::exists(ini) || !log.loadFromRawLogFile(demo.rawlog))
        throw std::runtime_error(demo.rawlog + " or " + ini + ": cannot be read");
    FILTER filter;
    filter.setMinLoggingLevel(mrpt::system::LVL_ERROR);
    filter.loadOptions(mrpt::config::CConfigFile(ini));
    filter.options.data_assoc_method =
        method == EStockMethod::jcbb ? mrpt::slam::assocJCBB : mrpt::slam::assocNN;
    mrpt::obs::CActionCollection::Ptr action;
    mrpt::obs::CSensoryFrame::Ptr frame;
    TDemoRun result;
    for (std::size_t entry = 0; entry + 1 < log.size();) {
        log.getActionObservationPair(action, frame, entry);
        const auto record = frame->getObservationByClass<mrpt::obs::CObservationBearingRange>();
        if (method != EStockMethod::identities)
            for (auto& sensed : record->sensedData) sensed.landmarkID = -1;
        const double start = processorTime();
        filter.processActionObservation(action, frame);
        result.seconds += processorTime() - start;
        result.path.push_back(positionOf(filter));
    }
    result.landmarks = landmarksOf(filter);
    return result;
}

}  // namespace

TDemoRun runStock2D(const TDemo& demo, const std::string& ini, EStockMethod method) {
    return run<mrpt::slam::CRangeBearingKFSLAM2D>(demo, ini, method);
}

TDemoRun runStock3D(const TDemo& demo, const std::string& ini, EStockMethod method) {
    return run<mrpt::slam::CRangeBearingKFSLAM>(demo, ini, method);
}

}  // namespace salma::bench
