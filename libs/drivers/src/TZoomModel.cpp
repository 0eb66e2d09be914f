// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/bits_math.h>
#include <salma/drivers/TZoomModel.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace salma::drivers {

std::vector<TZoomModel::TKnot> TZoomModel::knots() const {
    const double wide = std::tan(wideField / 2);
    const auto logFactor = [wide](double field) { return std::log(wide / std::tan(field / 2)); };
    std::vector<TKnot> all{{0, 0}};
    for (std::size_t i = 0; i + 1 < tableDegrees.size(); i += 2)
        all.push_back({tableDegrees[i], logFactor(mrpt::DEG2RAD(tableDegrees[i + 1]))});
    all.push_back({static_cast<double>(maxCounts), logFactor(teleField)});
    return all;
}

void TZoomModel::validate() const {
    bool good = tableDegrees.size() % 2 == 0;
    for (std::size_t i = 1; i < tableDegrees.size(); i += 2)
        good = good && tableDegrees[i] > 0 && tableDegrees[i] < 180;
    const auto all = knots();
    for (std::size_t i = 1; good && i < all.size(); ++i)
        good = all[i].counts > all[i - 1].counts && all[i].logFactor > all[i - 1].logFactor;
    if (!good)
        throw std::invalid_argument(
            "from field_wide_deg over field_table_deg (counts, field, ...) to field_tele_deg at "
            "zoom_max_counts, counts must rise and fields fall");
}

double TZoomModel::factor(int counts) const {
    const auto all = knots();
    const double at = std::clamp(counts, 0, maxCounts);
    std::size_t i = 1;
    while (i + 1 < all.size() && all[i].counts < at) ++i;
    const TKnot &a = all[i - 1], &b = all[i];
    const double part = (at - a.counts) / (b.counts - a.counts);
    return std::exp(a.logFactor + part * (b.logFactor - a.logFactor));
}

int TZoomModel::counts(double factor) const {
    const auto all = knots();
    const double at = std::clamp(std::log(factor), 0.0, all.back().logFactor);
    std::size_t i = 1;
    while (i + 1 < all.size() && all[i].logFactor < at) ++i;
    const TKnot &a = all[i - 1], &b = all[i];
    const double part = (at - a.logFactor) / (b.logFactor - a.logFactor);
    return static_cast<int>(std::lround(a.counts + part * (b.counts - a.counts)));
}

double TZoomModel::field(double factor) const {
    return 2 * std::atan(std::tan(wideField / 2) / factor);
}

}  // namespace salma::drivers
