// SPDX-License-Identifier: BSD-3-Clause
#include "proportion.h"

#include <boost/math/distributions/binomial.hpp>
#include <limits>
#include <stdexcept>

namespace salma::apps {

double TProportion::share() const {
    if (total == 0) return std::numeric_limits<double>::quiet_NaN();
    return static_cast<double>(count) / static_cast<double>(total);
}

TProportion proportion(std::size_t count, std::size_t total) {
    using Binomial = boost::math::binomial_distribution<double>;  // its default is the exact one
    constexpr double kTail = 0.025;
    if (count > total) throw std::invalid_argument("a proportion larger than 1");
    TProportion result{count, total, 0, 1};
    const auto hits = static_cast<double>(count), all = static_cast<double>(total);
    if (count > 0) result.low = Binomial::find_lower_bound_on_p(all, hits, kTail);
    if (count < total) result.high = Binomial::find_upper_bound_on_p(all, hits, kTail);
    return result;
}

}  // namespace salma::apps
