// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/hwdrivers/CGenericSensor.h>
#include <mrpt/system/COutputLogger.h>
#include <salma/sensing/CAttention.h>
#include <salma/sensing/CFrontEndWorker.h>
#include <salma/sensing/CJoinQueue.h>
#include <salma/sensing/CSourceSensor.h>
#include <salma/sensing/TSalientSensorOptions.h>
#include <salma/sensing/TSensingConfig.h>

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace salma::drivers {
class CPanTiltCameraSensor;
}

namespace salma::sensing {

/// What became of the pictures since the start.
struct TSensingCounts {
    std::size_t pictures{0};
    std::size_t records{0};
    std::size_t landmarks{0};                    //!< In the records.
    std::map<std::string, std::size_t> dropped;  //!< Pictures without a record, by reason.
};

/** The front end as a sensor of rawlog-grabber: writes `CObservationSalientLandmarks` while the
 * robot drives.
 *
 * No sensor of rawlog-grabber sees another's observations, so this one runs those that it needs by
 * itself: `camera`, `laser`, `head` and `odometry` name sections of the same file, which have
 * `rawlog-grabber-ignore = true`. All they deliver goes to the grabber too; pictures get the pose
 * of the head and, where `camera_params` is set, intrinsics. A picture for which the front end has
 * no time is dropped whole, counted and told: nothing ever queues. Records are those that
 * salma-slam makes of the same log, see CJoinQueue. With `attend` the head turns to what was seen
 * until it is confirmed, see CAttention. A source that fails ends this sensor, when the
 * pictures before that are done. */
class CSalientLandmarkSensor : public mrpt::system::COutputLogger,
                               public mrpt::hwdrivers::CGenericSensor {
    DEFINE_GENERIC_SENSOR(CSalientLandmarkSensor)

 public:
    CSalientLandmarkSensor();
    /// Tells the counts.
    ~CSalientLandmarkSensor() override;

    void setPathForExternalImages(const std::string& directory) override;
    /// Opens the sources, one after the other. \throw what they throw
    void initialize() override;
    /// Takes what came and hands on what is done; never waits for the front end.
    /// \throw std::runtime_error naming the section of a source that failed
    void doProcess() override;

    const TSensingCounts& counts() const { return m_counts; }

 protected:
    /// \throw std::invalid_argument naming section, key and value
    void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& file,
                                   const std::string& section) override;

 private:
    void load(const mrpt::config::CConfigFileBase& file, const std::string& section);
    void collect();
    void sort(const mrpt::obs::CObservation::Ptr& observation, const std::string& section);
    void handOver();
    void handOn();
    void createAttention();
    void lookAround();
    void drop(const std::string& reason, const std::string& detail = "");
    void report(const std::string& when);
    void throwIfSourceFailed();

    TSalientSensorOptions m_options;
    TSensingConfig m_config;
    std::optional<mrpt::img::TCamera> m_camera;
    std::string m_imagesFolder;
    std::vector<std::unique_ptr<CSourceSensor>> m_sources;
    std::unique_ptr<CJoinQueue> m_queue;
    std::unique_ptr<CFrontEndWorker> m_worker;
    drivers::CPanTiltCameraSensor* m_head{
        nullptr};  //!< One of the sources; null: not to be turned.
    std::optional<CAttention> m_attention;
    TSensingCounts m_counts;
    std::size_t m_jumpsTold{0};
    std::set<std::string> m_told;  //!< Reasons and details that were logged.
    double m_nextReport{0};        //!< By the steady clock [s].
};

}  // namespace salma::sensing
