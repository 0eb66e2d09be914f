// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/COptionVisitor.h>

#include <string>

namespace salma::drivers {

/// The keys that rawlog-grabber has for every sensor, with MRPT's names.
struct TGrabberKeys {
    std::string driver;
    std::string sensorLabel;
    double processRate{10};  //!< Calls of doProcess() a second.
    int maxQueue{200};
    int decimation{1};
    std::string ignore{"false"};

    TGrabberKeys(const char* itsDriver, const char* label, double rate)
        : driver(itsDriver), sensorLabel(label), processRate(rate) {}

 protected:
    /// \param rateHelp What `process_rate` means for this sensor.
    void visitGrabberKeys(config::COptionVisitor& v, const char* rateHelp);
};

}  // namespace salma::drivers
