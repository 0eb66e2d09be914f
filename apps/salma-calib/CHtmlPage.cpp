// SPDX-License-Identifier: BSD-3-Clause
#include "CHtmlPage.h"

#include <salma/viz/CReport.h>
#include <salma/viz/reportStyle.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace salma::apps {

using viz::escapeHtml;

CHtmlPage::CHtmlPage(const std::string& title)
    : m_body("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<title>salma: " +
             escapeHtml(title) + "</title>\n<style>" + viz::kReportStyle +
             "</style></head>\n<body>\n<h1>" + escapeHtml(title) + "</h1>\n") {}

void CHtmlPage::heading(const std::string& text) {
    m_body += "<h2>" + escapeHtml(text) + "</h2>\n";
}

void CHtmlPage::paragraph(const std::string& text) {
    m_body += "<p>" + escapeHtml(text) + "</p>\n";
}

void CHtmlPage::table(const std::vector<TRow>& rows) {
    m_body += "<table>";
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::string cell = i == 0 ? "th" : "td";
        m_body += i == 0 ? "<thead><tr>" : "<tr>";
        for (const auto& text : rows[i])
            m_body += "<" + cell + ">" + escapeHtml(text) + "</" + cell + ">";
        m_body += i == 0 ? "</tr></thead><tbody>\n" : "</tr>\n";
    }
    m_body += "</tbody></table>\n";
}

void CHtmlPage::picture(const std::string& file, const std::string& caption) {
    std::ifstream in(file, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    if (!in || bytes.empty()) throw std::runtime_error(file + ": cannot be read");
    m_body += "<figure><img alt=\"" + escapeHtml(caption) + "\" src=\"data:image/png;base64," +
              viz::base64(bytes) + "\"><figcaption>" + escapeHtml(caption) +
              "</figcaption></figure>\n";
}

}  // namespace salma::apps
