// SPDX-License-Identifier: BSD-3-Clause
#include <salma/drivers/TPanTiltCameraOptions.h>

#include <stdexcept>

namespace salma::drivers {
namespace {

using TMount = TPanTiltCameraOptions::TMount;

void visitMount(config::COptionVisitor& v,
                const std::string& name,
                TMount& mount,
                const std::string& frame) {
    const auto any = config::anyNumber();
    const auto turn = config::between(-180, 180);
    v.number(name + "_x_m", mount.x, any, frame);
    v.number(name + "_y_m", mount.y, any, frame);
    v.number(name + "_z_m", mount.z, any, frame);
    v.degrees(name + "_yaw_deg", mount.yaw, turn, frame);
    v.degrees(name + "_pitch_deg", mount.pitch, turn, frame);
    v.degrees(name + "_roll_deg", mount.roll, turn, frame);
}

}  // namespace

void TPanTiltCameraOptions::visit(config::COptionVisitor& v) {
    visitGrabberKeys(v, "records a second");
    v.text("port", port, "serial port, absolute or below /dev");
    camera.visit(v);
    v.integer("zoom_every", zoomEvery, config::atLeast(1),
              "ask for the zoom with each so-manyth record");
    v.number("reconnect_s", reconnectTime, config::between(0.01, 3600),
             "between attempts to reach a lost camera");
    visitMount(v, "base", base, "axes of the head, in the robot's frame");
    visitMount(v, "camera", cameraOnHead, "camera (optical frame), in the head's frame");
}

void TPanTiltCameraOptions::validate() const {
    checkRanges();
    camera.validate();
    if (driver != TPanTiltCameraOptions().driver)
        throw std::invalid_argument("driver = '" + driver + "' is not " +
                                    TPanTiltCameraOptions().driver);
    if (port.empty()) throw std::invalid_argument("port is empty");
}

}  // namespace salma::drivers
