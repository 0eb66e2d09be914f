// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/hwdrivers/CGenericSensor.h>
#include <mrpt/obs/CObservation.h>

#include <chrono>
#include <cstdio>
#include <string>

namespace salma::test {

/** A device that runs by its own clock and numbers what it gives, as a plug-in for rawlog-grabber
 * and salma-grab.
 *
 * It gives laser scans or pictures; the number of each, from 0, stands in the sensor's pose as z.
 * Each number is first written to the journal, a text file, so that what a grabber wrote can be
 * held against what it got. Faults on request: it fails, hangs, falls silent, or its clock jumps.
 */
class CEmulatedSensor : public mrpt::hwdrivers::CGenericSensor {
    DEFINE_GENERIC_SENSOR(CEmulatedSensor)

 public:
    CEmulatedSensor() = default;
    ~CEmulatedSensor() override;

    void initialize() override;
    /// All that the device gave since the last call.
    void doProcess() override;
    void setPathForExternalImages(const std::string& directory) override;

 protected:
    void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& file,
                                   const std::string& section) override;

 private:
    void emit(long number);
    mrpt::obs::CObservation::Ptr make(long number) const;
    static mrpt::obs::CObservation::Ptr scan(long number);
    mrpt::obs::CObservation::Ptr picture(long number) const;
    static mrpt::obs::CObservation::Ptr head(long number);
    static mrpt::obs::CObservation::Ptr odometry(long number);
    /// Faults that are due before `number` is given.
    void misbehave(long number);

    std::string m_kind{"laser"};  //!< laser, picture, odometry, or head (salma's own record).
    double m_deviceRate{10};      //!< Records a second, whenever doProcess() is called.
    std::string m_journalFile;
    long m_failAt{-1}, m_hangAt{-1}, m_silentFrom{-1}, m_jumpAt{-1}, m_blackFrom{-1},
        m_smallFrom{-1};
    double m_jump{0};  //!< [s]
    int m_failuresAtStart{0};
    int m_width{320}, m_height{240};
    std::FILE* m_journal{nullptr};
    std::chrono::steady_clock::time_point m_start;
    mrpt::Clock::time_point m_startStamp;
    long m_next{0};
};

}  // namespace salma::test
