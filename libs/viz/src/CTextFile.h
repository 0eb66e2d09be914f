// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fstream>
#include <ostream>
#include <string>

namespace salma::viz {

/** A text file whose every write is checked.
 *
 * The destructor does not report; call close(). */
class CTextFile {
 public:
    /// Creates or empties the file. \throw std::runtime_error naming it
    explicit CTextFile(std::string file);

    std::ostream& out() { return m_out; }

    /// Flushes and closes. \throw std::runtime_error naming the file if anything was not written.
    void close();

 private:
    std::string m_file;
    std::ofstream m_out;
};

/// 9 significant digits, independent of the locale; "" for NaN.
std::string number(double value);
/// 6 decimals, independent of the locale.
std::string stamp(double seconds);
/// `decimals` digits behind the point, independent of the locale; "" for NaN.
std::string fixed(double value, int decimals);

/// Whole content. \throw std::runtime_error naming the file if it cannot be read.
std::string readText(const std::string& file);

/// True if `text` holds one number and nothing else, independent of the locale.
bool parseNumber(const std::string& text, double& value);

}  // namespace salma::viz
