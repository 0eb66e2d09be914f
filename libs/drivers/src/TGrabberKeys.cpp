// SPDX-License-Identifier: BSD-3-Clause
#include <salma/drivers/TGrabberKeys.h>

namespace salma::drivers {

void TGrabberKeys::visitGrabberKeys(config::COptionVisitor& v, const char* rateHelp) {
    v.text("driver", driver, "read by rawlog-grabber");
    v.text("sensorLabel", sensorLabel, "name in the records");
    v.number("process_rate", processRate, config::moreThan(0), rateHelp);
    v.integer("max_queue_len", maxQueue, config::atLeast(1),
              "records that may wait for the grabber");
    v.integer("grab_decimation", decimation, config::atLeast(0), "keep one record of so many");
    v.text("rawlog-grabber-ignore", ignore, "true: not used");
}

}  // namespace salma::drivers
