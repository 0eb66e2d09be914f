// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/config/CConfigFileBase.h>
#include <salma/config/COptionVisitor.h>

#include <set>
#include <string>

namespace salma::config {

/** Reads one section of a configuration file without forgiving mistakes.
 *
 * MRPT keeps a default when a key is misspelt and reads a malformed number as zero. Here a missing
 * key keeps the caller's default, but a malformed or forbidden value and an unknown key are errors
 * that name file, section, key and value. */
class CStrictSection : public COptionVisitor {
 public:
    /// Both arguments must outlive this object; the section may be absent (all defaults).
    CStrictSection(const mrpt::config::CConfigFileBase& file, const std::string& section);

    /// Each overwrites `value` if `key` is present. \throw std::invalid_argument
    void number(const std::string& key,
                double& value,
                const TRange& range,
                const std::string& meaning = {}) override;
    void integer(const std::string& key,
                 int& value,
                 const TRange& range,
                 const std::string& meaning = {}) override;
    void flag(const std::string& key, bool& value, const std::string& meaning = {}) override;
    void text(const std::string& key, std::string& value, const std::string& meaning = {}) override;
    void numbers(const std::string& key,
                 std::vector<double>& values,
                 const TRange& range,
                 const std::string& meaning = {}) override;

    bool has(const std::string& key) const;

    /// \throw std::invalid_argument listing the keys of the section that nobody read.
    void rejectUnknownKeys() const;

    /// Throws std::invalid_argument "FILE: [section] key = 'text' problem"; for checks of the
    /// caller.
    [[noreturn]] void fail(const std::string& key, const std::string& problem) const;

 protected:
    void word(const std::string& key,
              std::size_t& index,
              const std::vector<std::string>& words,
              const std::string& meaning) override;

 private:
    /// Notes `key` as read; its text, or nothing if it is absent.
    bool find(const std::string& key, std::string& text);
    double parseNumber(const std::string& key, const std::string& text, const TRange& range) const;
    std::string where() const;

    const mrpt::config::CConfigFileBase& m_file;
    std::string m_section;
    std::set<std::string> m_read;
};

}  // namespace salma::config
