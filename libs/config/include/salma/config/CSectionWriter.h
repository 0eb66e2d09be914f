// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/COptionVisitor.h>

#include <ostream>
#include <string>

namespace salma::config {

/** Writes a section as config.ini documents it: every key with its value, meaning and range.
 * Numbers are written with the fewest digits that come within a billionth of the value. */
class CSectionWriter : public COptionVisitor {
 public:
    /// Writes "[section]" at once. `out` must outlive this object.
    CSectionWriter(std::ostream& out, const std::string& section);

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

 private:
    void line(const std::string& key, const std::string& value, const std::string& comment);

    std::ostream& m_out;
};

}  // namespace salma::config
