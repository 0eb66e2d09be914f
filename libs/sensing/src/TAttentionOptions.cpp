// SPDX-License-Identifier: BSD-3-Clause
#include <salma/sensing/TAttentionOptions.h>

namespace salma::sensing {

void TAttentionOptions::visit(config::COptionVisitor& v) {
    v.flag("attend", use, "the head turns to what was seen until it is confirmed by other views");
    v.number("attend_s", patience, config::moreThan(0),
             "what is not confirmed within this time is let go");
    v.degrees("attend_speed_deg", speed, config::insideOf(0, 1000), "of the head, in a second");
    v.degrees("attend_dead_band_deg", deadBand, config::between(0, 20),
              "smaller corrections are not made");
    v.degrees("rest_pan_deg", restPan, config::between(-180, 180),
              "where the head looks while nothing is to be confirmed");
    v.degrees("rest_tilt_deg", restTilt, config::between(-90, 90), "likewise");
}

}  // namespace salma::sensing
