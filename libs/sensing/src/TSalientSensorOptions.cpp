// SPDX-License-Identifier: BSD-3-Clause
#include <salma/sensing/TSalientSensorOptions.h>

#include <stdexcept>

namespace salma::sensing {

void TSalientSensorOptions::visit(config::COptionVisitor& v) {
    v.text("driver", driver, "read by rawlog-grabber");
    v.text("sensorLabel", sensorLabel, "name in the records; empty: the camera's and _SALIENT");
    v.number("process_rate", processRate, config::moreThan(0),
             "looks for new observations a second");
    v.integer("max_queue_len", maxQueue, config::atLeast(1),
              "observations that may wait for the grabber");
    v.integer("grab_decimation", decimation, config::between(0, 1), "1 or 0: keep all");
    v.text("rawlog-grabber-ignore", ignore, "true: not used");
    v.text("camera", camera, "section of the camera");
    v.text("laser", laser, "section of the laser");
    v.text("head", head, "section of the pan/tilt head; empty: the camera is fixed");
    v.text("odometry", odometry, "section of the odometry; empty: none");
    v.text("config", config, "config.ini of salma-slam; empty: its defaults");
    v.text("camera_params", cameraParams,
           "file with [CAMERA_PARAMS]; empty: the pictures carry their own");
    v.integer("threads", threads, config::between(1, 64),
              "pictures that are worked on at the same time");
    v.number("wait_s", wait, config::between(0, 60),
             "longest wait for the scan, head pose and odometry of a picture");
    v.number("report_s", report, config::atLeast(0),
             "between two lines on what was dropped; 0: at the end only");
    attention.visit(v);
}

void TSalientSensorOptions::validate() const {
    checkRanges();
    if (driver != TSalientSensorOptions().driver)
        throw std::invalid_argument("driver = '" + driver + "' is not " +
                                    TSalientSensorOptions().driver);
    if (camera.empty()) throw std::invalid_argument("camera names no section");
    if (laser.empty()) throw std::invalid_argument("laser names no section");
    attention.validate();
    if (attention.use && head.empty()) throw std::invalid_argument("attend needs a head");
}

}  // namespace salma::sensing
