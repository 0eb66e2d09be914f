// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/hwdrivers/CGenericSensor.h>
#include <mrpt/obs/CObservation.h>

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace salma::sensing {

/** A sensor of another section, run in a thread of its own as rawlog-grabber would run it. */
class CSourceSensor {
 public:
    /** \throw std::invalid_argument naming the section: it is not there, it lacks
     * `rawlog-grabber-ignore = true` (rawlog-grabber would open the device a second time), its
     * driver is not known, or it has no process_rate; what the driver throws */
    CSourceSensor(const mrpt::config::CConfigFileBase& file, const std::string& section);
    ~CSourceSensor();
    CSourceSensor(const CSourceSensor&) = delete;
    CSourceSensor& operator=(const CSourceSensor&) = delete;

    /** Opens the device; `run()` then starts the thread. \throw what the driver throws */
    void initialize(const std::string& imagesFolder);
    void run();

    /// What was observed since the last call, in order of time.
    std::vector<mrpt::obs::CObservation::Ptr> take();

    /// What the driver threw: then its thread has ended. "" while all is well.
    std::string failure() const;
    /// Observations that nobody took in time.
    std::size_t lost() const;

    const std::string& section() const { return m_section; }
    mrpt::hwdrivers::CGenericSensor& sensor() { return *m_sensor; }

 private:
    void loop();
    void collect();

    const std::string m_section;
    mrpt::hwdrivers::CGenericSensor::Ptr m_sensor;
    mutable std::mutex m_mutex;  //!< Of all that follows.
    std::condition_variable m_news;
    std::vector<mrpt::obs::CObservation::Ptr> m_seen;
    std::size_t m_lost{0};
    std::string m_failure;
    bool m_stop{false};
    std::thread m_thread;
};

}  // namespace salma::sensing
