// SPDX-License-Identifier: BSD-3-Clause
#include "TGrabOptions.h"

#include <stdexcept>

namespace salma::apps {

void TGlobalOptions::visit(config::COptionVisitor& v) {
    v.text("rawlog_prefix", prefix, "begin of the log's name, without --out");
    v.integer("time_between_launches", launchPause, config::between(0, 60000),
              "milliseconds between the starts of two sensors");
    v.choice("use_sensoryframes", sensoryFrames,
             {{"0", false}, {"1", true}, {"false", false}, {"true", true}},
             "actions and sensory frames instead of single observations");
    v.number("SF_max_time_span", frameTimeSpan, config::moreThan(0),
             "longest time that a sensory frame spans [s]");
    v.integer("GRABBER_PERIOD_MS", grabberPeriod, config::atLeast(1),
              "rawlog-grabber's; here [salma-grab] member_s decides");
    v.integer("rawlog_GZ_compress_level", compression, config::between(0, 9),
              "0: not compressed, 1: fast, 9: small");
}

void TGrabOptions::visit(config::COptionVisitor& v) {
    v.text("rawlog-grabber-ignore", ignore,
           "true: rawlog-grabber takes this section for no sensor");
    v.choice("on_sensor_failure", onFailure,
             {{"continue", EOnFailure::carryOn},
              {"restart", EOnFailure::restart},
              {"stop", EOnFailure::stop}},
             "the others go on, it is started again, or all stop");
    v.number("restart_s", restartTime, config::between(0.01, 3600),
             "between attempts to start a failed sensor");
    v.number("hold_s", holdTime, config::between(0, 1),
             "a record waits so long for older ones of other sensors");
    v.number("member_s", memberTime, config::insideOf(0, 1),
             "what was written is whole on the disk after so long");
    v.number("silent_s", silentTime, config::moreThan(0),
             "a sensor that gives nothing for so long is told");
    v.number("stop_s", stopTime, config::between(0.1, 600), "sensors may take so long to end");
    v.flag("external_pictures", externalPictures, "pictures as files in X_Images");
    v.flag("check_pictures", checkPictures, "look for black, cut and missing pictures");
}

void TGrabOptions::validate() const {
    checkRanges();
    if (!(holdTime + memberTime <= 0.9))
        throw std::invalid_argument(
            "[salma-grab] hold_s and member_s: more than 0.9 s together; a crash must not cost "
            "more than a second");
}

}  // namespace salma::apps
