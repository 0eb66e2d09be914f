// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace salma::apps {

/// A report of one page with its pictures inside, in the style of salma-slam's.
class CHtmlPage {
 public:
    using TRow = std::vector<std::string>;

    explicit CHtmlPage(const std::string& title);

    void heading(const std::string& text);
    void paragraph(const std::string& text);
    /// The first row is the head.
    void table(const std::vector<TRow>& rows);
    /// \throw std::runtime_error naming the file if it cannot be read.
    void picture(const std::string& file, const std::string& caption);

    std::string html() const { return m_body + "</body></html>\n"; }

 private:
    std::string m_body;
};

}  // namespace salma::apps
