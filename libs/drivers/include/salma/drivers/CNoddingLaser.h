// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/drivers/CLms200.h>
#include <salma/drivers/CNoddingSweep.h>
#include <salma/drivers/TNoddingLaserOptions.h>

#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace salma::drivers {

/// What became of the scans.
struct TNoddingCounts {
    std::size_t sweeps{0};        //!< Written.
    std::size_t smallSweeps{0};   //!< Below `min_sweep_deg`.
    std::size_t placedScans{0};   //!< With a known elevation.
    std::size_t droppedScans{0};  //!< Without: the mount was silent.
};

/** A LMS 200 on a mount that nods, as a sensor of rawlog-grabber: writes one point cloud
 * (`CObservationPointCloud`, robot frame) for each sweep up or down.
 *
 * The mount says where it stands, in sentences of CSentenceParser: `$NOD,elevation_deg*HH`, upwards
 * positive, 20 to 100 times a second. A thread stamps them as they come; each beam is placed by the
 * elevation at its own time. The robot must stand still during a sweep. The stamp of a cloud is
 * that of its last scan. With `write_scans` each scan is also written with the pose of its middle
 * beam, as laser::CPlaneExtractor takes them: those after the stamp of one cloud, up to that of the
 * next, are a sweep. Laser or mount lost:
 * as CLms200; there are no sweeps meanwhile.
 * Source: K.-L. Ho, transfer report, Oxford, 2004, section 4.4.1 (-20 to +40 deg). */
class CNoddingLaser : public mrpt::system::COutputLogger, public mrpt::hwdrivers::CGenericSensor {
    DEFINE_GENERIC_SENSOR(CNoddingLaser)

 public:
    CNoddingLaser();
    ~CNoddingLaser() override;

    /// \throw CPortError naming the port and what is wrong
    void initialize() override;
    /// Throws nothing for a lost laser or mount.
    void doProcess() override;

    const TNoddingCounts& counts() const { return m_counts; }

 protected:
    /// \throw std::invalid_argument naming section, key and value
    void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& file,
                                   const std::string& section) override;

 private:
    using Scan = mrpt::obs::CObservation2DRangeScan;

    void findMount();
    void listen();
    void remember(double time, double elevation);
    void tell(const std::string& news);
    void logNews();
    void placeScans();
    bool place(const Scan::Ptr& scan, const CElevationHistory& elevations);
    mrpt::poses::CPose3D mirrorPose(double elevation) const;
    void write(const std::vector<TPlacedScan>& sweep);

    TNoddingLaserOptions m_options;
    CLms200 m_laser;
    std::deque<Scan::Ptr> m_waiting;  //!< For an elevation that is later than they.
    CNoddingSweep m_sweep;
    TNoddingCounts m_counts;
    std::mutex m_mutex;  //!< Of what the listener writes: m_elevations, m_news.
    CElevationHistory m_elevations;
    std::vector<std::string> m_news;  //!< To be logged by doProcess(): a logger has one thread.
    std::atomic<bool> m_stop{false};
    std::thread m_listener;
};

}  // namespace salma::drivers
