// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/Clock.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <salma/config/withoutBrackets.h>
#include <salma/drivers/CNoddingLaser.h>

#include <chrono>
#include <cmath>
#include <stdexcept>

#include "CSentenceLine.h"
#include "steadyNow.h"

IMPLEMENTS_GENERIC_SENSOR(CNoddingLaser, salma::drivers)

namespace salma::drivers {
namespace {

using mrpt::poses::CPose3D;

constexpr double mirrorPeriod = 1 / 75.0;     // one turn [s]
constexpr std::size_t maxWaitingScans = 150;  // two seconds of them

}  // namespace

CNoddingLaser::CNoddingLaser() : mrpt::system::COutputLogger("CNoddingLaser") {
    m_state = ssUninitialized;
    m_sensorLabel = m_options.laser.sensorLabel;
}

CNoddingLaser::~CNoddingLaser() {
    m_stop = true;
    if (m_listener.joinable()) m_listener.join();
}

void CNoddingLaser::loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& file,
                                              const std::string& section) {
    setLoggerName(section);
    try {
        m_options.loadFromConfigFile(file, section);
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(config::withoutBrackets(error.what()));
    }
    TLms200Options laser = m_options.laser;
    laser.driver = TLms200Options().driver;
    m_laser.setOptions(laser);
    m_laser.setSensorLabel(m_sensorLabel);
    m_laser.setLoggerName(section);
}

void CNoddingLaser::initialize() {
    findMount();
    m_laser.setMinLoggingLevel(getMinLoggingLevel());
    m_laser.initialize();
    m_listener = std::thread([this] { listen(); });
    m_state = ssWorking;
}

void CNoddingLaser::findMount() {
    const double start = steadyNow();
    CSentenceLine mount(m_options.mountPort, m_options.mountBaud);
    while (steadyNow() - start < m_options.laser.silence)
        for (const auto& sentence : mount.read(0.1))
            if (sentence.name == "NOD") return;
    throw CPortError(m_options.mountPort + ": no elevation ($NOD) comes from there");
}

/// Reads from the mount until the end, whatever happens to it.
void CNoddingLaser::listen() {
    CReconnection reconnection;
    std::unique_ptr<CSentenceLine> mount;
    bool wasLost = false;
    while (!m_stop) {
        try {
            if (!mount && !reconnection.due()) {
                std::this_thread::sleep_for(std::chrono::milliseconds(10));
                continue;
            }
            if (!mount)
                mount = std::make_unique<CSentenceLine>(m_options.mountPort, m_options.mountBaud);
            for (const TSentence& sentence : mount->read(0.05)) {
                if (sentence.name != "NOD" || sentence.values.size() != 1) continue;
                remember(sentence.began - m_options.mountLatency,
                         mrpt::DEG2RAD(sentence.values[0]));
                if (wasLost) tell("mount found again at " + m_options.mountPort);
                wasLost = false;
                reconnection.found();
            }
        } catch (const CPortError& error) {
            mount.reset();
            wasLost = true;
            if (reconnection.lost(error.what(), m_options.laser.reconnectTime))
                tell(std::string("mount lost: ") + error.what());
        }
    }
}

void CNoddingLaser::remember(double time, double elevation) {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_elevations.add(time, elevation);
}

void CNoddingLaser::tell(const std::string& news) {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_news.push_back(news);
}

void CNoddingLaser::logNews() {
    std::vector<std::string> news;
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        news.swap(m_news);
    }
    for (const auto& line : news) MRPT_LOG_WARN_STREAM(line);
}

void CNoddingLaser::doProcess() {
    logNews();
    m_laser.doProcess();
    for (const auto& entry : m_laser.getObservations())
        m_waiting.push_back(std::dynamic_pointer_cast<Scan>(entry.second));
    m_state = m_laser.getState();
    placeScans();
}

void CNoddingLaser::placeScans() {
    CElevationHistory elevations;
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        elevations = m_elevations;
    }
    while (!m_waiting.empty()) {
        const double stamp = mrpt::Clock::toDouble(m_waiting.front()->timestamp);
        const bool known = elevations.end() && *elevations.end() >= stamp + mirrorPeriod / 2;
        if (!known && m_waiting.size() <= maxWaitingScans) return;
        if (!known || !place(m_waiting.front(), elevations)) {
            ++m_counts.droppedScans;
            m_sweep.clear();  // one with a hole is none
        }
        m_waiting.pop_front();
    }
}

CPose3D CNoddingLaser::mirrorPose(double elevation) const {
    const TLms200Options& axis = m_options.laser;
    return CPose3D(axis.x, axis.y, axis.z, mrpt::DEG2RAD(axis.yaw), mrpt::DEG2RAD(axis.pitch),
                   mrpt::DEG2RAD(axis.roll)) +
           CPose3D(0, 0, 0, 0, -elevation, 0) +
           CPose3D(m_options.mirrorX, 0, m_options.mirrorZ, 0, 0, 0);
}

/// False if the mount's elevation at the time of the scan is not known.
bool CNoddingLaser::place(const Scan::Ptr& scan, const CElevationHistory& elevations) {
    const double stamp = mrpt::Clock::toDouble(scan->timestamp);
    const auto middle = elevations.at(stamp, m_options.maxGap);
    if (!middle) return false;
    TPlacedScan placed{scan, *middle, {}};
    scan->sensorPose = mirrorPose(*middle);
    const auto last = static_cast<double>(scan->getScanSize() - 1);
    for (std::size_t i = 0; i < scan->getScanSize(); ++i) {
        if (!scan->getScanRangeValidity(i)) continue;
        const double bearing = (static_cast<double>(i) / last - 0.5) * scan->aperture;
        const auto elevation =
            elevations.at(stamp + bearing / (2 * M_PI) * mirrorPeriod, m_options.maxGap);
        if (!elevation) return false;
        const double range = scan->getScanRange(i);
        const auto point =
            mirrorPose(*elevation)
                .composePoint({range * std::cos(bearing), range * std::sin(bearing), 0});
        placed.points.emplace_back(static_cast<float>(point.x), static_cast<float>(point.y),
                                   static_cast<float>(point.z));
    }
    ++m_counts.placedScans;
    if (m_options.writeScans) appendObservation(scan);
    write(m_sweep.add(std::move(placed)));
    return true;
}

void CNoddingLaser::write(const std::vector<TPlacedScan>& sweep) {
    if (sweep.empty()) return;
    const double span = std::abs(sweep.back().elevation - sweep.front().elevation);
    if (!(span >= m_options.minSweep)) {
        ++m_counts.smallSweeps;
        return;
    }
    auto points = mrpt::maps::CSimplePointsMap::Create();
    for (const TPlacedScan& placed : sweep) {
        for (const auto& point : placed.points) points->insertPointFast(point.x, point.y, point.z);
    }
    points->mark_as_modified();
    auto cloud = mrpt::obs::CObservationPointCloud::Create();
    cloud->sensorLabel = m_sensorLabel + "_CLOUD";
    cloud->timestamp = sweep.back().scan->timestamp;
    cloud->pointcloud = points;
    appendObservation(cloud);
    ++m_counts.sweeps;
}

}  // namespace salma::drivers
