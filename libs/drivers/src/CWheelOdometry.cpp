// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/Clock.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <salma/config/withoutBrackets.h>
#include <salma/drivers/CWheelOdometry.h>

#include <stdexcept>

#include "CSentenceLine.h"
#include "steadyNow.h"

IMPLEMENTS_GENERIC_SENSOR(CWheelOdometry, salma::drivers)

namespace salma::drivers {

void TWheelOdometryOptions::visit(config::COptionVisitor& v) {
    visitGrabberKeys(v, "looks a second");
    v.text("port", port, "serial port, absolute or below /dev");
    v.integer("baud", baud, config::between(300, 500000), "rate of the serial port");
    v.number("latency_s", latency, config::between(0, 1),
             "from the reading of the wheels to the first byte");
    v.number("silence_s", silence, config::between(0.2, 3600),
             "a base that says nothing so long is lost");
    v.number("reconnect_s", reconnectTime, config::between(0.01, 3600),
             "between attempts to reach a lost base");
}

void TWheelOdometryOptions::validate() const {
    checkRanges();
    if (driver != TWheelOdometryOptions().driver)
        throw std::invalid_argument("driver = '" + driver + "' is not " +
                                    TWheelOdometryOptions().driver);
    if (port.empty()) throw std::invalid_argument("port is empty");
}

CWheelOdometry::CWheelOdometry() : mrpt::system::COutputLogger("CWheelOdometry") {
    m_state = ssUninitialized;
    m_sensorLabel = m_options.sensorLabel;  // loadConfig() keeps it where the section names none
}

CWheelOdometry::~CWheelOdometry() = default;

void CWheelOdometry::loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& file,
                                               const std::string& section) {
    setLoggerName(section);
    try {
        m_options.loadFromConfigFile(file, section);
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(config::withoutBrackets(error.what()));
    }
}

void CWheelOdometry::initialize() {
    m_line = std::make_unique<CSentenceLine>(m_options.port, m_options.baud);
    m_lastRecord = steadyNow();
    while (!record(0.1))
        if (steadyNow() - m_lastRecord > m_options.silence) {
            m_line.reset();
            throw CPortError(m_options.port + ": no odometry ($ODO) comes from there");
        }
    m_state = ssWorking;
    MRPT_LOG_INFO_STREAM("odometry comes from " << m_options.port);
}

void CWheelOdometry::doProcess() {
    if (!m_line) return reconnect();
    try {
        if (!record(0.05) && steadyNow() - m_lastRecord > m_options.silence)
            lost(m_options.port + ": no odometry for " + std::to_string(m_options.silence) + " s");
    } catch (const CPortError& error) {
        lost(error.what());
    }
}

/// True if odometry came within `timeout` [s].
bool CWheelOdometry::record(double timeout) {
    bool any = false;
    for (const TSentence& sentence : m_line->read(timeout)) {
        if (sentence.name != "ODO" || sentence.values.size() != 3) continue;
        auto odometry = mrpt::obs::CObservationOdometry::Create();
        odometry->sensorLabel = m_sensorLabel;
        odometry->timestamp = mrpt::Clock::fromDouble(sentence.began - m_options.latency);
        odometry->odometry = {sentence.values[0], sentence.values[1],
                              mrpt::DEG2RAD(sentence.values[2])};
        appendObservation(odometry);
        any = true;
    }
    if (any) m_lastRecord = steadyNow();
    return any;
}

void CWheelOdometry::reconnect() {
    if (!m_reconnection.due()) return;
    try {
        m_line = std::make_unique<CSentenceLine>(m_options.port, m_options.baud);
        m_lastRecord = steadyNow();
        m_reconnection.found();
        m_state = ssWorking;
        MRPT_LOG_WARN_STREAM("odometry: " << m_options.port << " is back");
    } catch (const CPortError& error) {
        lost(error.what());
    }
}

void CWheelOdometry::lost(const std::string& problem) {
    m_line.reset();
    m_state = ssError;
    if (m_reconnection.lost(problem, m_options.reconnectTime))
        MRPT_LOG_ERROR_STREAM("odometry lost: " << problem);
}

}  // namespace salma::drivers
