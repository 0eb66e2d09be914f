// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace salma::viz {

/** A CSV file of known columns, read strictly: no quotes, no missing and no further columns.
 *
 * Errors name file and line. Rows count from 0, without the header. */
class CCsvTable {
 public:
    /** \param columns The header that the file must have.
     * \throw std::runtime_error if the file cannot be read; std::invalid_argument for another
     * header or a row with another number of cells. */
    CCsvTable(const std::string& file, std::vector<std::string> columns);

    std::size_t rows() const { return m_cells.size(); }

    const std::string& text(std::size_t row, const std::string& column) const;

    /// \throw std::invalid_argument unless the cell holds one finite number.
    double number(std::size_t row, const std::string& column) const;
    /// NaN for an empty cell. \throw std::invalid_argument as number()
    double numberOrNaN(std::size_t row, const std::string& column) const;
    /// \throw std::invalid_argument unless the cell holds one integer that fits.
    int integer(std::size_t row, const std::string& column) const;
    /// `none` for an empty cell. \throw std::invalid_argument as integer()
    int integerOr(std::size_t row, const std::string& column, int none) const;

    /// Throws std::invalid_argument "FILE:LINE: column = 'text' problem".
    [[noreturn]] void fail(std::size_t row,
                           const std::string& column,
                           const std::string& problem) const;

 private:
    std::size_t columnIndex(const std::string& column) const;

    std::string m_file;
    std::vector<std::string> m_columns;
    std::vector<std::vector<std::string>> m_cells;
    std::vector<std::size_t> m_lines;  //!< Line of each row in the file, from 1.
};

}  // namespace salma::viz
