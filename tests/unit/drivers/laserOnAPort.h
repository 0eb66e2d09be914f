// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <messages.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <salma/drivers/CLms200.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "CSickLms200.h"
#include "CTemporaryFolder.h"

namespace salma::test {

/// An emulated laser at the end of a pseudo-terminal, 3 m before a wall that ends 6 m to the left.
class LaserOnAPort : public testing::Test {
 protected:
    using Scan = mrpt::obs::CObservation2DRangeScan;

    std::string port() const { return (m_folder / "laser").string(); }

    std::string ini(const std::string& more) const {
        return "[LASER]\ndriver = CLms200\nprocess_rate = 90\nsensorLabel = LASER\nCOM_port_LIN "
               "= " +
               port() + "\nreconnect_s = 0.01\n" + more;
    }
    void load(drivers::CLms200& sensor, const std::string& more) const {
        sensor.setMinLoggingLevel(mrpt::system::LVL_ERROR);
        sensor.loadConfig(mrpt::config::CConfigFileMemory(ini(more)), "LASER");
    }

    /// Lets the sensor work until `n` scans have come; fewer if that takes a minute.
    static std::vector<Scan::Ptr> take(mrpt::hwdrivers::CGenericSensor& sensor, std::size_t n) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
        std::vector<Scan::Ptr> scans;
        while (scans.size() < n && std::chrono::steady_clock::now() < end) {
            sensor.doProcess();
            for (const auto& entry : sensor.getObservations())
                scans.push_back(std::dynamic_pointer_cast<Scan>(entry.second));
        }
        return scans;
    }

    static std::vector<double> look(const TLmsView& view) {
        std::vector<double> ranges;
        for (std::size_t i = 0; i < view.beams(); ++i) {
            const double bearing =
                (static_cast<double>(i) * view.resolution / 100 - view.aperture / 2.0) * M_PI / 180;
            const bool wall = std::cos(bearing) > 1e-9 && 3 * std::tan(bearing) <= 6;
            ranges.push_back(wall ? 3 / std::cos(bearing)
                                  : std::numeric_limits<double>::infinity());
        }
        return ranges;
    }

    /// Whether the points of the scan lie on the wall, and only beams past its end hit nothing.
    static void expectTheWall(const Scan& scan, double tolerance) {
        const double step = scan.aperture / static_cast<double>(scan.getScanSize() - 1);
        for (std::size_t i = 0; i < scan.getScanSize(); ++i) {
            const double bearing = static_cast<double>(i) * step - scan.aperture / 2.0;
            const double range = 3 / std::cos(bearing);
            const bool seen = 3 * std::tan(bearing) < 6.001 && range > 0 && range < scan.maxRange;
            ASSERT_EQ(scan.getScanRangeValidity(i), seen) << i;
            ASSERT_NEAR(scan.getScanRange(i), seen ? range : 0, tolerance) << i;
        }
    }

    CTemporaryFolder m_folder;
    CSickLms200 m_device{[this](const TLmsView& view, double now) {
        m_looks.push_back(now);
        return look(view);
    }};
    std::vector<double> m_looks;  //!< When the device looked [s]; read it locked.
    CEmulator m_emulator{m_device, port()};
};

/// What a call says when it throws; "" if it does not.
}  // namespace salma::test
