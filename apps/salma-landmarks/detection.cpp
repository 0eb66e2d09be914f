// SPDX-License-Identifier: BSD-3-Clause
#include "detection.h"

#include <array>
#include <cmath>
#include <limits>

namespace salma::apps {

std::vector<TDetectionCell> detection(const std::vector<TLabelledRun>& runs) {
    constexpr std::array<double, 8> kDegrees{0, 15, 30, 45, 55, 65, 75, 90};
    constexpr std::array<double, 7> kMetres{
        0, 1.5, 2.5, 3.5, 5, 7, std::numeric_limits<double>::infinity()};
    std::vector<TDetectionCell> cells;
    for (std::size_t i = 0; i + 1 < kDegrees.size(); ++i)
        for (std::size_t j = 0; j + 1 < kMetres.size(); ++j) {
            TDetectionCell cell{kDegrees[i] * M_PI / 180,
                                kDegrees[i + 1] * M_PI / 180,
                                kMetres[j],
                                kMetres[j + 1],
                                {}};
            std::size_t total = 0, count = 0;
            for (const auto& run : runs)
                for (const auto& view : run.views) {
                    if (view.kind != association::ELandmarkKind::salient) continue;
                    if (view.incidence < cell.incidenceFrom || view.incidence >= cell.incidenceTo ||
                        view.range < cell.rangeFrom || view.range >= cell.rangeTo)
                        continue;
                    ++total;
                    if (view.seen) ++count;
                }
            if (total == 0) continue;
            cell.seen = proportion(count, total);
            cells.push_back(cell);
        }
    return cells;
}

}  // namespace salma::apps
