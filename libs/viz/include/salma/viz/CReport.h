// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/viz/CRunWriter.h>

#include <string>

namespace salma::viz {

/// PNG files to embed, as CPlots.h draws them.
struct TReportFigures {
    std::string map;
    std::string innovations;
};

/** The report of a run: one HTML file that needs nothing beside it.
 *
 * Pictures are embedded, texts from outside are escaped, there is no script. */
class CReport {
 public:
    explicit CReport(TReportInput input);

    /// \throw std::runtime_error if a figure cannot be read.
    std::string html(const TReportFigures& figures) const;

 private:
    std::string headline() const;
    std::string accuracy() const;
    std::string landmarkTable() const;
    std::string doubtfulTable() const;
    std::string notices() const;
    std::string refusals() const;

    TReportInput m_input;
};

/// `text` with the characters that HTML gives a meaning replaced: & < > " '.
std::string escapeHtml(const std::string& text);

/// RFC 4648, with padding.
std::string base64(const std::string& bytes);

}  // namespace salma::viz
