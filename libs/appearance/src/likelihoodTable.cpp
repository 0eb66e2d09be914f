// SPDX-License-Identifier: BSD-3-Clause
#include "likelihoodTable.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace salma::appearance {

void checkTable(const std::vector<double>& x,
                const std::vector<double>& y,
                const std::string& section) {
    const std::string place = "[" + section + "] ";
    if (x.size() != y.size() || x.size() < 2)
        throw std::invalid_argument(
            place + "score_knots and log_lr_knots must have the same length, 2 or more");
    if (!(x.front() == 0 && x.back() == 1))
        throw std::invalid_argument(place + "score_knots must run from 0 to 1");
    for (std::size_t i = 1; i < x.size(); ++i)
        if (!(x[i - 1] < x[i] && y[i - 1] <= y[i]))
            throw std::invalid_argument(
                place + "score_knots must ascend and log_lr_knots must not descend");
}

double readTable(const std::vector<double>& x, const std::vector<double>& y, double score) {
    const double s = std::clamp(score, 0.0, 1.0);
    std::size_t i = 1;
    while (i + 1 < x.size() && s > x[i]) ++i;
    return y[i - 1] + (y[i] - y[i - 1]) * (s - x[i - 1]) / (x[i] - x[i - 1]);
}

double withDuplicates(double logRatio, double duplicateRate) {
    const double ratio = std::exp(logRatio);
    return std::log(ratio / (1 - duplicateRate + duplicateRate * ratio));
}

}  // namespace salma::appearance
