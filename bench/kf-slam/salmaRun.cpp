// SPDX-License-Identifier: BSD-3-Clause
#include "salmaRun.h"

#include <CMapping.h>
#include <backend.h>
#include <salma/observations/CLogReader.h>

#include <cmath>
#include <ctime>

namespace salma::bench {

TDemoRun runSalma(const TDemo& demo, const apps::TSlamConfig& config) {
    const observations::TLog log = observations::readLog(demo.rawlog);
    const auto backend = apps::createBackend(config);
    slam::TRunRecord record;
    const auto start = std::clock();
    apps::CMapping(config, log, *backend).run({}, record);
    TDemoRun result;
    result.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    for (const auto& row : record.trajectory)
        result.path.emplace_back(row.pose.x(), row.pose.y(), row.spatial ? row.spatial->z() : 0);
    for (const auto& landmark : record.landmarks)
        result.landmarks.emplace_back(landmark.mean.x, landmark.mean.y,
                                      std::isnan(landmark.z) ? 0 : landmark.z);
    return result;
}

}  // namespace salma::bench
