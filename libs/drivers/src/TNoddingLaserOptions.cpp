// SPDX-License-Identifier: BSD-3-Clause
#include <salma/drivers/TNoddingLaserOptions.h>

#include <stdexcept>

namespace salma::drivers {

TNoddingLaserOptions::TNoddingLaserOptions() {
    laser.driver = "CNoddingLaser";
    laser.sensorLabel = "NODDING";
}

void TNoddingLaserOptions::visit(config::COptionVisitor& v) {
    laser.visit(v);
    v.text("mount_port", mountPort, "serial port of the mount, absolute or below /dev");
    v.integer("mount_baud", mountBaud, config::between(300, 500000), "its rate");
    v.number("mount_latency_s", mountLatency, config::between(0, 1),
             "from the reading of the angle to the first byte");
    v.number("mirror_x_m", mirrorX, config::anyNumber(), "mirror before the axis, at elevation 0");
    v.number("mirror_z_m", mirrorZ, config::anyNumber(), "mirror above the axis, at elevation 0");
    v.number("max_gap_s", maxGap, config::between(0.001, 10),
             "between two angles that are interpolated");
    v.degrees("min_sweep_deg", minSweep, config::between(1, 180), "smaller sweeps are dropped");
    v.flag("write_scans", writeScans, "also as 2-D scans with their pose; not for salma-slam");
}

void TNoddingLaserOptions::validate() const {
    checkRanges();
    const TNoddingLaserOptions defaults;
    if (laser.driver != defaults.laser.driver)
        throw std::invalid_argument("driver = '" + laser.driver + "' is not " +
                                    defaults.laser.driver);
    if (mountPort.empty()) throw std::invalid_argument("mount_port is empty");
    if (laser.port.empty()) throw std::invalid_argument("COM_port_LIN is empty");
}

}  // namespace salma::drivers
