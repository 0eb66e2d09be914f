// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <messages.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "CProcess.h"
#include "CRunningProcess.h"
#include "CTemporaryFolder.h"

namespace salma::test {

/// Number of a record and its stamp [s].
using TNumbered = std::vector<std::pair<long, double>>;

/// Emulated sensors, each with a journal of what it gave, and salma-grab to record them.
class CEmulatedRobot {
 public:
    /// A laser at 75 Hz, a camera at 10 Hz, and a pan/tilt head at 20 Hz, whose records are
    /// salma's.
    void addUsualSensors();
    void addSensor(const std::string& section,
                   const std::string& kind,
                   double rate,
                   const std::string& more = "");
    /// The ini file of all sensors. \param head Sections before them.
    std::string ini(const std::string& head = "") const;
    std::string log() const { return (m_folder / "x.rawlog").string(); }
    std::string companion() const { return (m_folder / "x.salient.rawlog").string(); }

    std::vector<std::string> command(const std::vector<std::string>& more = {}) const;
    TProcessResult grab(const std::vector<std::string>& more) const {
        return runProcess(command(more));
    }

    /// What the device gave, by its journal. The last line may be half written.
    TNumbered given(const std::string& section) const;
    /// Waits until the device has given so many records; false if the process ends before.
    bool waitFor(const std::string& section, std::size_t records, CRunningProcess& process) const;
    /// Records of a log by sensor label, in the order of the file.
    static std::map<std::string, TNumbered> recorded(const std::string& file);
    /// Each record that the sensors gave is in the log or its companion, once, in order.
    void expectAllRecorded() const;

    /// What `section` lost is not asked for.
    void forgive(const std::string& section);

 protected:
    CTemporaryFolder m_folder;
    std::string m_sections;
    std::vector<std::string> m_names;
    std::string m_head{"[global]\ntime_between_launches = 0\n"};
};

class CRobotTest : public testing::Test, public CEmulatedRobot {};

}  // namespace salma::test
