// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/hwdrivers/CGenericSensor.h>
#include <mrpt/system/COutputLogger.h>
#include <salma/config/TStrictOptions.h>
#include <salma/drivers/CReconnection.h>
#include <salma/drivers/TGrabberKeys.h>

#include <memory>
#include <string>

namespace salma::drivers {

class CSentenceLine;

/// A section of a rawlog-grabber ini file for CWheelOdometry.
struct TWheelOdometryOptions : public config::TStrictOptions<TWheelOdometryOptions>,
                               public TGrabberKeys {
    TWheelOdometryOptions() : TGrabberKeys("CWheelOdometry", "ODOMETRY", 500) {}

    std::string port{"/dev/ttyS0"};
    int baud{115200};
    double latency{0};        //!< From the reading of the wheels to the first byte [s].
    double silence{3};        //!< A base that says nothing so long is lost [s].
    double reconnectTime{1};  //!< Between attempts to reach a base that was lost [s].

    void visit(config::COptionVisitor& visitor);
    /// \throw std::invalid_argument naming the key.
    void validate() const;
};

/** Odometry of a robot's base as a sensor of rawlog-grabber: writes `CObservationOdometry`.
 *
 * The base (or a small program that speaks with it, through a pseudo-terminal) says where its
 * wheels have brought it since it was switched on, in sentences of CSentenceParser:
 * `$ODO,x_m,y_m,heading_deg*HH`, heading positive to the left. A port that is not there or a base
 * that says nothing when the program starts is an error; one that is lost later is told once,
 * looked for every `reconnect_s`, and carried on with. */
class CWheelOdometry : public mrpt::system::COutputLogger, public mrpt::hwdrivers::CGenericSensor {
    DEFINE_GENERIC_SENSOR(CWheelOdometry)

 public:
    CWheelOdometry();
    ~CWheelOdometry() override;

    /// \throw CPortError naming the port and what is wrong
    void initialize() override;
    /// All that has come; throws nothing for a lost base.
    void doProcess() override;

 protected:
    /// \throw std::invalid_argument naming section, key and value
    void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& file,
                                   const std::string& section) override;

 private:
    void reconnect();
    bool record(double timeout);
    void lost(const std::string& problem);

    TWheelOdometryOptions m_options;
    std::unique_ptr<CSentenceLine> m_line;  //!< Empty while the base is lost.
    double m_lastRecord{0};                 //!< By the steady clock [s].
    CReconnection m_reconnection;
};

}  // namespace salma::drivers
