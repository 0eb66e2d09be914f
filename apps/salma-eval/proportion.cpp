// SPDX-License-Identifier: BSD-3-Clause
#include "proportion.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace salma::apps {
namespace {

constexpr double kTail = 0.025;

/// Probability of `from` to `to` successes among n, each of probability p in (0, 1).
double binomial(std::size_t from, std::size_t to, std::size_t n, double p) {
    const auto real = [](std::size_t i) { return static_cast<double>(i); };
    double sum = 0;
    for (std::size_t i = from; i <= to; ++i)
        sum += std::exp(std::lgamma(real(n) + 1) - std::lgamma(real(i) + 1) -
                        std::lgamma(real(n - i) + 1) + real(i) * std::log(p) +
                        real(n - i) * std::log1p(-p));
    return sum;
}

/// Where `isBelow` turns from true to false in (0, 1).
template <class IS_BELOW>
double bisect(const IS_BELOW& isBelow) {
    double low = 0, high = 1;
    for (int i = 0; i < 50; ++i) {  // to 1e-15
        const double middle = (low + high) / 2;
        (isBelow(middle) ? low : high) = middle;
    }
    return (low + high) / 2;
}

}  // namespace

double TProportion::share() const {
    if (total == 0) return std::numeric_limits<double>::quiet_NaN();
    return static_cast<double>(count) / static_cast<double>(total);
}

TProportion proportion(std::size_t count, std::size_t total) {
    if (count > total) throw std::invalid_argument("a proportion larger than 1");
    TProportion result{count, total, 0, 1};
    if (count > 0)
        result.low = bisect([&](double p) { return binomial(count, total, total, p) < kTail; });
    if (count < total)
        result.high = bisect([&](double p) { return binomial(0, count, total, p) > kTail; });
    return result;
}

}  // namespace salma::apps
