// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/COptionVisitor.h>

#include <string>

namespace salma::config {

/** Checks values that were not read from a file.
 * \throw std::invalid_argument from the first key whose value is outside its range. */
class CRangeCheck : public COptionVisitor {
 public:
    void number(const std::string& key,
                double& value,
                const TRange& range,
                const std::string& meaning) override;
    void integer(const std::string& key,
                 int& value,
                 const TRange& range,
                 const std::string& meaning) override;
    void flag(const std::string& key, bool& value, const std::string& meaning) override;
    void text(const std::string& key, std::string& value, const std::string& meaning) override;
    void numbers(const std::string& key,
                 std::vector<double>& values,
                 const TRange& range,
                 const std::string& meaning) override;

 protected:
    void word(const std::string& key,
              std::size_t& index,
              const std::vector<std::string>& words,
              const std::string& meaning) override;
};

}  // namespace salma::config
