// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace salma::test {

using TBytes = std::vector<std::uint8_t>;

/// The device's end of a serial cable: a pseudo-terminal whose other end programs open by a link.
class CPseudoTerminal {
 public:
    /// Plugs in. \param link Path of the symbolic link to make. \throw std::runtime_error
    explicit CPseudoTerminal(std::string link);
    ~CPseudoTerminal() { unplug(); }
    CPseudoTerminal(const CPseudoTerminal&) = delete;
    CPseudoTerminal& operator=(const CPseudoTerminal&) = delete;

    /// Who has the port open sees it go away, as when a USB adapter is pulled out.
    void unplug();
    /// A new port under the old link. \throw std::runtime_error
    void plug();

    /// Bytes that the computer sent; waits for the first at most `timeoutMs`.
    TBytes read(int timeoutMs);
    /// What does not fit into the terminal because nobody reads is lost.
    void write(const TBytes& bytes);

    /// Rate that the computer's end is set to; 0 for one that no device here knows.
    int baud() const;

    const std::string& link() const { return m_link; }

 private:
    std::string m_link;
    int m_device{-1};
    int m_computer{-1};  //!< Held open, or each program that closes its end would hang up the line.
};

}  // namespace salma::test
