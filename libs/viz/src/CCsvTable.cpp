// SPDX-License-Identifier: BSD-3-Clause
#include <salma/viz/CCsvTable.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "CTextFile.h"

namespace salma::viz {
namespace {

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> cells(1);
    for (const char c : line) {
        if (c == ',')
            cells.emplace_back();
        else
            cells.back() += c;
    }
    return cells;
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const auto& word : words) text += (text.empty() ? "" : ",") + word;
    return text;
}

bool nextLine(std::istream& in, std::string& line) {
    if (!std::getline(in, line)) return false;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return true;
}

}  // namespace

CCsvTable::CCsvTable(const std::string& file, std::vector<std::string> columns)
    : m_file(file), m_columns(std::move(columns)) {
    std::istringstream in(readText(file));
    std::string line;
    if (!nextLine(in, line) || line != joined(m_columns))
        throw std::invalid_argument(file + ":1: the header must be " + joined(m_columns));
    for (std::size_t number = 2; nextLine(in, line); ++number) {
        auto cells = split(line);
        if (cells.size() != m_columns.size())
            throw std::invalid_argument(file + ":" + std::to_string(number) + ": " +
                                        std::to_string(cells.size()) + " cells instead of " +
                                        std::to_string(m_columns.size()));
        m_cells.push_back(std::move(cells));
        m_lines.push_back(number);
    }
}

std::size_t CCsvTable::columnIndex(const std::string& column) const {
    const auto found = std::find(m_columns.begin(), m_columns.end(), column);
    if (found == m_columns.end())
        throw std::invalid_argument(m_file + ": is read without a column " + column);
    return static_cast<std::size_t>(found - m_columns.begin());
}

const std::string& CCsvTable::text(std::size_t row, const std::string& column) const {
    return m_cells.at(row)[columnIndex(column)];
}

double CCsvTable::number(std::size_t row, const std::string& column) const {
    double value = 0;
    if (!parseNumber(text(row, column), value) || !std::isfinite(value))
        fail(row, column, "is not a finite number");
    return value;
}

double CCsvTable::numberOrNaN(std::size_t row, const std::string& column) const {
    if (text(row, column).empty()) return std::numeric_limits<double>::quiet_NaN();
    return number(row, column);
}

int CCsvTable::integer(std::size_t row, const std::string& column) const {
    const std::string& cell = text(row, column);
    const char* end = cell.data() + cell.size();
    int value = 0;
    const auto [last, error] = std::from_chars(cell.data(), end, value);
    if (error != std::errc() || last != end) fail(row, column, "is not an integer");
    return value;
}

int CCsvTable::integerOr(std::size_t row, const std::string& column, int none) const {
    return text(row, column).empty() ? none : integer(row, column);
}

void CCsvTable::fail(std::size_t row, const std::string& column, const std::string& problem) const {
    throw std::invalid_argument(m_file + ":" + std::to_string(m_lines.at(row)) + ": " + column +
                                " = '" + text(row, column) + "' " + problem);
}

}  // namespace salma::viz
