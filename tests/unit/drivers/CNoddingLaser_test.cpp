// SPDX-License-Identifier: BSD-3-Clause
// The whole way: a laser and its mount on pseudo-terminals in a simulated corridor, and what
// laser::CPlaneExtractor makes of the records.
#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <salma/config/CStrictFile.h>
#include <salma/drivers/CNoddingLaser.h>
#include <salma/drivers/CSerialLine.h>
#include <salma/drivers/registerSensors.h>
#include <salma/laser/CPlaneExtractor.h>
#include <salma/simulator/CNoddingLaserModel.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "CSickLms200.h"
#include "CTalker.h"
#include "CTemporaryFolder.h"

using namespace salma;
using drivers::CNoddingLaser;
using laser::EPlaneKind;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationPointCloud;

namespace {

constexpr double kDegree = M_PI / 180;

/// 3 m wide, 2.6 m high; the robot stands 1.2 m from its left wall and 4 m before its end.
const char* const kCorridor =
    "[path]\npoints_m = 0 0 1 0\nclosed = false\nlaps = 1\n[laser]\nmode = cm\naperture_deg = 180\n"
    "resolution_deg = 1\n[wall_south]\nfrom_m = 4 -1.8\nto_m = -6 -1.8\n"
    "[wall_east]\nfrom_m = 4 1.2\nto_m = 4 -1.8\n[wall_north]\nfrom_m = -6 1.2\nto_m = 4 1.2\n"
    "[wall_west]\nfrom_m = -6 -1.8\nto_m = -6 1.2\n";

/// Up and down between -20 and 40 deg at 30 deg/s.
double elevationAt(double now) {
    const double phase = std::fmod(now, 4.0);
    return (phase < 2 ? -20 + 30 * phase : 100 - 30 * phase) * kDegree;
}

class NoddingLaser : public testing::Test {
 protected:
    std::string laserPort() const { return (m_folder / "laser").string(); }
    std::string mountPort() const { return (m_folder / "mount").string(); }

    void load(const std::string& more = "") {
        m_sensor.setMinLoggingLevel(mrpt::system::LVL_ERROR);
        m_sensor.loadConfig(
            mrpt::config::CConfigFileMemory(
                "[NODDING]\ndriver = CNoddingLaser\nprocess_rate = 500\nsensorLabel = NODDING\n"
                "COM_baudRate = 500000\nresolution = 100\nsilence_s = 0.5\nreconnect_s = 0.01\n"
                "pose_x = 0.18\npose_z = 0.4\nCOM_port_LIN = " +
                laserPort() + "\nmount_port = " + mountPort() + "\n" + more),
            "NODDING");
    }

    /// What was said before it fell silent may still be on its way.
    static void drainPort(const std::string& port) {
        drivers::CSerialLine line(port, 115200);
        while (!line.read(0.1).empty()) {
        }
    }

    std::string startMessage() {
        try {
            m_sensor.initialize();
        } catch (const std::exception& error) {
            return error.what();
        }
        return "";
    }

    /// Lets the sensor work until `n` sweeps are there; fewer if that takes a minute.
    void work(std::size_t n) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
        while (m_clouds.size() < n && std::chrono::steady_clock::now() < end) {
            m_sensor.doProcess();
            for (const auto& [stamp, record] : m_sensor.getObservations()) {
                if (auto cloud = std::dynamic_pointer_cast<CObservationPointCloud>(record))
                    m_clouds.push_back(cloud);
                if (auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(record))
                    m_scans.push_back(scan);
            }
        }
    }

    /// The scans of sweep `k`.
    std::vector<CObservation2DRangeScan> sweep(std::size_t k) const {
        std::vector<CObservation2DRangeScan> scans;
        for (const auto& scan : m_scans)
            if (scan->timestamp <= m_clouds[k]->timestamp &&
                (k == 0 || scan->timestamp > m_clouds[k - 1]->timestamp))
                scans.push_back(*scan);
        return scans;
    }

    test::CTemporaryFolder m_folder;
    simulator::TWorld m_description =
        simulator::loadWorld(m_folder.write("corridor.ini", kCorridor));
    simulator::CWorld m_world{m_description};
    simulator::CNoddingLaserModel m_model{m_description.laser, {}, m_world, 1};
    std::uint64_t m_index{0};
    test::CSickLms200 m_laser{[this](const test::TLmsView& view, double now) {
        const double half = view.aperture / 360.0 / 75 / 2;  // of the time that the beams take
        const auto scan =
            m_model.scan({0, 0, 0}, elevationAt(now - half), elevationAt(now + half), m_index++);
        std::vector<double> ranges;
        for (std::size_t i = 0; i < scan.getScanSize(); ++i)
            ranges.push_back(scan.getScanRangeValidity(i)
                                 ? scan.getScanRange(i)
                                 : std::numeric_limits<double>::infinity());
        return ranges;
    }};
    test::CTalker m_mount{
        "NOD", 50, [](double now) { return std::vector<double>{elevationAt(now) / kDegree}; }};
    test::CEmulator m_laserEnd{m_laser, laserPort()};
    test::CEmulator m_mountEnd{m_mount, mountPort()};
    CNoddingLaser m_sensor;
    std::vector<CObservationPointCloud::Ptr> m_clouds;
    std::vector<CObservation2DRangeScan::Ptr> m_scans;
};

}  // namespace

TEST_F(NoddingLaser, ACorridorHasItsWallsFloorAndCeilingInTheirPlaces) {
    load("write_scans = true\n");
    ASSERT_EQ(startMessage(), "");
    work(3);
    ASSERT_GE(m_clouds.size(), 3U);
    EXPECT_EQ(m_clouds[0]->sensorLabel, "NODDING_CLOUD");
    struct TSide {
        Eigen::Vector3d normal;
        double distance;
        EPlaneKind kind;
    };
    const TSide sides[] = {{{1, 0, 0}, 4, EPlaneKind::wall},
                           {{0, 1, 0}, 1.2, EPlaneKind::wall},
                           {{0, -1, 0}, 1.8, EPlaneKind::wall},
                           {{0, 0, 1}, 2.6, EPlaneKind::ceiling},
                           {{0, 0, -1}, 0, EPlaneKind::floor}};
    // The middle sweep is whole. Laser: 5 mm noise, up to 15 mm offset, steps of 10 mm.
    const auto planes = laser::CPlaneExtractor().extract(sweep(1)).planes;
    for (const TSide& side : sides) {
        bool found = false;
        for (const auto& plane : planes) {
            const double sign = plane.normal.dot(side.normal) < 0 ? -1 : 1;
            found |= plane.kind == side.kind && sign * plane.normal.dot(side.normal) > 0.9995 &&
                     std::abs(sign * plane.distance - side.distance) < 0.04;
        }
        EXPECT_TRUE(found) << side.normal.transpose();
    }
    // The cloud: nearly all points lie on the corridor's sides.
    const auto& points = *m_clouds[1]->pointcloud;
    ASSERT_GT(points.size(), 5000U);
    std::size_t off = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        double x = 0, y = 0, z = 0;
        points.getPoint(i, x, y, z);
        const double distance = std::min({std::abs(x - 4), std::abs(y - 1.2), std::abs(y + 1.8),
                                          std::abs(z), std::abs(z - 2.6)});
        off += distance > 0.08 ? 1 : 0;
    }
    EXPECT_LT(static_cast<double>(off), 0.05 * static_cast<double>(points.size()));
}

TEST_F(NoddingLaser, WithoutTheMountThereAreNoSweepsAndWithItThereAreAgain) {
    load();
    ASSERT_EQ(startMessage(), "");
    work(1);
    ASSERT_EQ(m_clouds.size(), 1U);
    EXPECT_TRUE(m_scans.empty());
    m_mountEnd.unplug();
    const std::size_t before = m_sensor.counts().droppedScans;
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (m_sensor.counts().droppedScans == before && std::chrono::steady_clock::now() < end)
        EXPECT_NO_THROW(m_sensor.doProcess());
    EXPECT_GT(m_sensor.counts().droppedScans, before);
    m_mountEnd.plug();
    work(2);
    EXPECT_GE(m_clouds.size(), 2U);
}

TEST_F(NoddingLaser, PortsThatAreMissingOrSilentAtTheStartAreErrors) {
    load();
    m_mountEnd.locked([&] { m_mount.silence(true); });
    drainPort(mountPort());
    EXPECT_EQ(startMessage(), mountPort() + ": no elevation ($NOD) comes from there");
    m_mountEnd.unplug();
    EXPECT_EQ(startMessage(), mountPort() + ": no such serial port, or nothing is plugged in");
    m_mountEnd.locked([&] { m_mount.silence(false); });
    m_mountEnd.plug();
    m_laserEnd.unplug();
    EXPECT_EQ(startMessage(), laserPort() + ": no such serial port, or nothing is plugged in");
}

TEST_F(NoddingLaser, ItsSectionIsReadStrictly) {
    EXPECT_THROW(load("mirror_y_m = 1\n"), std::exception);
    EXPECT_THROW(load("FOV = 90\n"), std::exception);
    const drivers::TNoddingLaserOptions options;
    drivers::TNoddingLaserOptions loaded;
    loaded.mirrorX = 1;
    loaded.loadFromConfigFile(mrpt::config::CConfigFileMemory(options.asIni("NODDING")), "NODDING");
    EXPECT_EQ(loaded.asIni("NODDING"), options.asIni("NODDING"));
    const auto file = config::openStrict(SALMA_SOURCE_DIR "/share/grabber/nodding-laser.ini");
    EXPECT_NO_THROW(loaded.loadFromConfigFile(*file, "NODDING"));
    EXPECT_EQ(loaded.mirrorZ, 0.05);
    drivers::registerSensors();
    EXPECT_TRUE(mrpt::hwdrivers::CGenericSensor::createSensorPtr("CNoddingLaser"));
    EXPECT_TRUE(mrpt::hwdrivers::CGenericSensor::createSensorPtr("CWheelOdometry"));
}
