// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace salma::apps {

/// How often something happened, with the Clopper-Pearson interval of 95 %.
struct TProportion {
    std::size_t count{0}, total{0};
    double low{0}, high{1};

    /// NaN for a total of 0.
    double share() const;
};

/** The exact interval: the probabilities at which `count` or more, and `count` or fewer, of `total`
 * have a chance of 2.5 % each. [0, 1] for a total of 0.
 * \throw std::invalid_argument if `count` exceeds `total`.
 * Source: C. J. Clopper and E. S. Pearson, Biometrika 26(4), 1934. */
TProportion proportion(std::size_t count, std::size_t total);

}  // namespace salma::apps
