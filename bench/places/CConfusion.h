// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/laser/EPlaceClass.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <ostream>

namespace salma::bench {

/// What was taken for what, kept apart by building.
class CConfusion {
 public:
    struct TInterval {
        double value, low, high;
    };

    void add(std::uint32_t building, laser::EPlaceClass truth, laser::EPlaceClass answer);

    /** Mean over the classes of the share that is right, with the interval of 95 % from 2000 draws
     * of whole buildings (poses of one building are not independent). Classes that a draw lacks do
     * not count in it. */
    TInterval balancedAccuracy() const;

    std::size_t total() const;

    /// A Markdown table: rows are what is there, columns what was said.
    void write(std::ostream& out) const;

 private:
    using TCounts = std::array<std::array<std::size_t, laser::kPlaceClasses>, laser::kPlaceClasses>;
    static double balanced(const TCounts& counts);
    TCounts sum() const;

    std::map<std::uint32_t, TCounts> m_counts;
};

}  // namespace salma::bench
