// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace salma::apps {

/// The mean of independent values, with Student's interval of 95 %.
struct TMean {
    std::size_t count{0};
    double mean{std::numeric_limits<double>::quiet_NaN()};  //!< NaN without values.
    double low{std::numeric_limits<double>::quiet_NaN()};   //!< NaN below two values; so `high`.
    double high{std::numeric_limits<double>::quiet_NaN()};
};

/// NaN among `values` is left out.
TMean meanInterval(const std::vector<double>& values);

/// The middle one, or the mean of the two middle ones; NaN without values, or with NaN among them.
double median(std::vector<double> values);

}  // namespace salma::apps
