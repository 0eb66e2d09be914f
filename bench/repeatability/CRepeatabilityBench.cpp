// SPDX-License-Identifier: BSD-3-Clause
#include "CRepeatabilityBench.h"

#include <salma/saliency/regionFiles.h>

#include <utility>

#include "CProgressBar.h"
#include "parallelFor.h"

namespace fs = std::filesystem;

namespace salma::bench {
namespace {

using RegionsOfSet = std::vector<TDetector::Regions>;

void writeRegions(const fs::path& folder, const std::string& detector, const RegionsOfSet& set) {
    fs::create_directories(folder);
    for (std::size_t i = 0; i < set.size(); ++i)
        saliency::writeVgg((folder / ("img" + std::to_string(i + 1) + "." + detector)).string(),
                           set[i]);
}

/// Regions of the same sizes and density at wrong places.
saliency::TRegionView turnedRound(saliency::TRegionView view) {
    for (auto& region : view.regions) {
        region.u = view.picture.width - 1 - region.u;
        region.v = view.picture.height - 1 - region.v;
    }
    return view;
}

}  // namespace

CRepeatabilityBench::CRepeatabilityBench(std::vector<TDetector> detectors,
                                         const TBenchOptions& options)
    : m_detectors(std::move(detectors)), m_options(options) {}

std::vector<TBenchRow> CRepeatabilityBench::run(const TPictureSet& set,
                                                const fs::path& regionFolder) const {
    const std::vector<std::pair<std::string, std::optional<std::size_t>>> points = {
        {"default", std::nullopt}, {"strongest", m_options.strongest}};
    apps::CProgressBar progress(set.name, points.size() * m_detectors.size() * set.pictures.size());
    std::vector<TBenchRow> rows;
    for (const auto& [point, most] : points)
        for (const auto& detector : m_detectors) {
            RegionsOfSet regions(set.pictures.size());
            apps::parallelFor(regions.size(), m_options.threads, [&, most = most](std::size_t i) {
                regions[i] = detector.detect(set.pictures[i], most);
                progress.step();
            });
            writeRegions(regionFolder / set.name / point, detector.name, regions);
            for (auto& row : compare(set, detector, regions)) {
                row.point = point;
                rows.push_back(std::move(row));
            }
        }
    return rows;
}

std::vector<TBenchRow> CRepeatabilityBench::compare(const TPictureSet& set,
                                                    const TDetector& detector,
                                                    const RegionsOfSet& regions) const {
    saliency::TRepeatabilityOptions options;
    options.maxOverlapError = m_options.maxOverlapError;
    options.windowScale = detector.windowScale;
    const saliency::CRepeatability measure(options);
    const saliency::TRegionView first{regions[0], set.pictures[0].size()};
    std::vector<TBenchRow> rows(regions.size() - 1);
    apps::parallelFor(rows.size(), m_options.threads, [&](std::size_t i) {
        const cv::Matx33d& H = set.H_picture_first[i + 1];
        const saliency::TRegionView second{regions[i + 1], set.pictures[i + 1].size()};
        rows[i] = {set.name,
                   detector.name,
                   "",
                   i + 2,
                   viewChange(H, first.picture),
                   first.regions.size(),
                   second.regions.size(),
                   measure.compare(first, second, H),
                   measure.compare(first, turnedRound(second), H).rate()};
    });
    return rows;
}

}  // namespace salma::bench
