// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "CEmulator.h"

namespace salma::test {

/** A controller that says a sentence `$NAME,number,...*HH` at a rate, unasked: the base of a robot,
 * a nodding mount. 115200 baud. */
class CTalker : public CEmulatedDevice {
 public:
    /// \param values What it says at a time. \param rate Sentences a second.
    CTalker(std::string name, double rate, std::function<std::vector<double>(double now)> values)
        : m_name(std::move(name)), m_period(1 / rate), m_values(std::move(values)) {}

    void receive(const TBytes&, int, double) override {}
    TBytes transmit(double now) override;
    int baud() const override { return 115200; }

    /// Nothing reaches the line.
    void silence(bool silent) { m_silent = silent; }
    /// Each second sentence has a wrong checksum, each fourth breaks off.
    void garble(bool garbled) { m_garbled = garbled; }
    int sentences() const { return m_sentences; }

 private:
    std::string m_name;
    double m_period;
    std::function<std::vector<double>(double now)> m_values;
    double m_next{0};
    bool m_silent{false}, m_garbled{false};
    int m_sentences{0};
};

}  // namespace salma::test
