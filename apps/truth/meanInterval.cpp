// SPDX-License-Identifier: BSD-3-Clause
#include "meanInterval.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace salma::apps {

TMean meanInterval(const std::vector<double>& values) {
    TMean result;
    double sum = 0;
    for (const double value : values)
        if (!std::isnan(value)) {
            sum += value;
            ++result.count;
        }
    if (result.count == 0) return result;
    const auto n = static_cast<double>(result.count);
    result.mean = sum / n;
    if (result.count < 2) return result;
    double squares = 0;
    for (const double value : values)
        if (!std::isnan(value)) squares += (value - result.mean) * (value - result.mean);
    const boost::math::students_t_distribution<double> student(n - 1);
    const double half = boost::math::quantile(student, 0.975) * std::sqrt(squares / (n - 1) / n);
    result.low = result.mean - half;
    result.high = result.mean + half;
    return result;
}

double median(std::vector<double> values) {
    const bool known =
        std::none_of(values.begin(), values.end(), [](double value) { return std::isnan(value); });
    if (values.empty() || !known) return std::numeric_limits<double>::quiet_NaN();
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

}  // namespace salma::apps
