// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/bits_math.h>
#include <salma/config/COptionVisitor.h>

#include <cmath>
#include <sstream>

namespace salma::config {

bool TRange::contains(double value) const {
    if (!std::isfinite(value)) return false;
    return (minOpen ? value > min : value >= min) && (maxOpen ? value < max : value <= max);
}

std::string TRange::asString() const {
    std::ostringstream out;
    out << (minOpen || std::isinf(min) ? "(" : "[") << min << ", " << max
        << (maxOpen || std::isinf(max) ? ")" : "]");
    return out.str();
}

void COptionVisitor::degrees(const std::string& key,
                             double& radians,
                             const TRange& range,
                             const std::string& meaning) {
    const double before = mrpt::RAD2DEG(radians);
    double after = before;
    number(key, after, range, meaning);
    if (after != before) radians = mrpt::DEG2RAD(after);
}

}  // namespace salma::config
