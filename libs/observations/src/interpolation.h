// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

namespace salma::observations {

/// Where an instant lies between two entries of a history.
struct TBracket {
    std::size_t before{0};
    std::size_t after{0};  //!< Equal to `before` at an entry and beyond the ends.
    double part{0};        //!< 0 at `before`, 1 at `after`.
};

/** \param timeOf Stamp of entry i < size; strictly increasing.
 * \return Nothing if there are no entries, `time` is NaN, or it lies more than `maxSkew` [s]
 * outside. */
template <class TIME_OF>
std::optional<TBracket> bracket(std::size_t size, TIME_OF timeOf, double time, double maxSkew) {
    if (size == 0) return std::nullopt;
    if (!(time >= timeOf(0) - maxSkew && time <= timeOf(size - 1) + maxSkew)) return std::nullopt;
    if (time <= timeOf(0)) return TBracket{0, 0, 0};
    if (time >= timeOf(size - 1)) return TBracket{size - 1, size - 1, 0};
    std::size_t low = 0;          // timeOf(low) <= time
    std::size_t high = size - 1;  // timeOf(high) > time
    while (high - low > 1) {
        const std::size_t middle = (low + high) / 2;
        (timeOf(middle) <= time ? low : high) = middle;
    }
    return TBracket{low, high, (time - timeOf(low)) / (timeOf(high) - timeOf(low))};
}

}  // namespace salma::observations
