// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sstream>
#include <string>

namespace salma::viz {

/** A gnuplot script with its data inside, run as a child process without any other file.
 *
 * The script must not set an output: what it draws goes to the file of run(). */
class CGnuplot {
 public:
    /// Starts the script with a pcairo PNG terminal of this size [px].
    CGnuplot(int width, int height);

    std::ostream& script() { return m_script; }

    /** Opens a named data block; close it with endData(). */
    std::ostream& data(const std::string& name);
    void endData() { m_script << "EOD\n"; }

    /** Runs gnuplot.
     * \throw std::runtime_error naming `file` if gnuplot cannot be started, reports an error or
     * leaves no whole PNG. */
    void run(const std::string& file) const;

 private:
    std::ostringstream m_script;
};

}  // namespace salma::viz
