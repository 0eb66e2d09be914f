// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/config/CConfigFileBase.h>
#include <mrpt/hwdrivers/CGenericSensor.h>

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <thread>

#include "CPendingRecords.h"

namespace salma::apps {

/** One sensor of the ini file in a thread of its own: made, started, asked at its rate, and made
 * anew after a failure if that is wanted. */
class CSensorThread {
 public:
    struct TSettings {
        std::string imagesFolder;  //!< For external pictures; "" keeps them in the log.
        bool restart{false};       //!< After a failure.
        double restartTime{2};     //!< [s]
    };

    enum class EPhase { waiting, starting, working, failed, ended };

    /// How it goes, at one moment.
    struct TStatus {
        EPhase phase{EPhase::waiting};
        std::size_t records{0};
        std::size_t backwards{0};  //!< Records with an earlier stamp than the one before.
        double worstStep{0};       //!< Longest of these steps back [s].
        std::size_t failures{0};
        bool down{false};     //!< Has not worked since the last failure.
        std::string problem;  //!< Of the last failure, one line.
        double age{0};        //!< [s] since the last record, or since the start.
    };

    /** Makes the sensor and reads its section, without touching the device.
     * \param file Must outlive this object.
     * \throw std::runtime_error, std::invalid_argument naming section and key */
    CSensorThread(std::string section,
                  const mrpt::config::CConfigFileBase& file,
                  TSettings settings,
                  CPendingRecords& records);
    /// \pre Not started, or ended.
    ~CSensorThread();
    CSensorThread(const CSensorThread&) = delete;
    CSensorThread& operator=(const CSensorThread&) = delete;

    void start();
    /// Asks it to end; returns at once.
    void stop();
    bool ended() const;
    TStatus status() const;
    const std::string& section() const { return m_section; }

 private:
    using TSteady = std::chrono::steady_clock;

    mrpt::hwdrivers::CGenericSensor::Ptr make() const;
    void run();
    /// From initialize() until stop() or an exception.
    void work(mrpt::hwdrivers::CGenericSensor& sensor);
    void collect(mrpt::hwdrivers::CGenericSensor& sensor);
    /// What threads inside the sensor, which save pictures, still have to give.
    void collectLate(mrpt::hwdrivers::CGenericSensor& sensor);
    void setPhase(EPhase phase);
    void noteWorking();
    void noteFailure(const std::string& problem);
    /// False once stop() was called.
    bool waitUntil(TSteady::time_point time);

    const std::string m_section;
    const mrpt::config::CConfigFileBase& m_file;
    const TSettings m_settings;
    CPendingRecords& m_records;
    mrpt::hwdrivers::CGenericSensor::Ptr m_sensor;  //!< The first one, until the thread takes it.
    bool m_ownThreads{false};  //!< The sensor saves pictures in threads of its own.

    mutable std::mutex m_mutex;  //!< Of what follows.
    std::condition_variable m_stopped;
    bool m_stop{false};
    TStatus m_status;
    TSteady::time_point m_lastArrival;
    mrpt::Clock::time_point m_lastStamp{mrpt::Clock::time_point::min()};
    std::thread m_thread;
};

}  // namespace salma::apps
