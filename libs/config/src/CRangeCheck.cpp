// SPDX-License-Identifier: BSD-3-Clause
#include <salma/config/CRangeCheck.h>

#include <sstream>
#include <stdexcept>

namespace salma::config {
namespace {

void check(const std::string& key, double value, const TRange& range) {
    if (range.contains(value)) return;
    std::ostringstream text;
    text << key << " = " << value << " is outside " << range.asString();
    throw std::invalid_argument(text.str());
}

}  // namespace

void CRangeCheck::number(const std::string& key,
                         double& value,
                         const TRange& range,
                         const std::string&) {
    check(key, value, range);
}

void CRangeCheck::integer(const std::string& key,
                          int& value,
                          const TRange& range,
                          const std::string&) {
    check(key, value, range);
}

void CRangeCheck::numbers(const std::string& key,
                          std::vector<double>& values,
                          const TRange& range,
                          const std::string&) {
    for (const double value : values) check(key, value, range);
}

void CRangeCheck::flag(const std::string&, bool&, const std::string&) {}

void CRangeCheck::text(const std::string&, std::string&, const std::string&) {}

void CRangeCheck::word(const std::string&,
                       std::size_t&,
                       const std::vector<std::string>&,
                       const std::string&) {}

}  // namespace salma::config
