// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/hwdrivers/CGenericSensor.h>
#include <mrpt/obs/CObservation.h>

#include <string>
#include <vector>

namespace salma::test {

/** Plays the observations of one label of a rawlog as if they were seen now.
 *
 * Keys: `rawlog`, `label`, `speed` (seconds of the log in one second), `stamps` (log: as they are
 * in the log, now: of the clock), `fail_at_end` (throw when all is played). All of a process start
 * together, when the last of them is ready. External pictures are embedded. */
class CReplaySensor : public mrpt::hwdrivers::CGenericSensor {
    DEFINE_GENERIC_SENSOR(CReplaySensor)

 public:
    void initialize() override;
    void doProcess() override;

 protected:
    void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& file,
                                   const std::string& section) override;

 private:
    std::string m_rawlog, m_label;
    double m_speed{1};
    bool m_stampNow{false}, m_failAtEnd{false};
    double m_logStart{0};
    std::vector<mrpt::obs::CObservation::Ptr> m_observations;
    std::size_t m_next{0};
};

}  // namespace salma::test
