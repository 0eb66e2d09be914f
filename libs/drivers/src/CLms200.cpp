// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/Clock.h>
#include <salma/config/withoutBrackets.h>
#include <salma/drivers/CLms200.h>
#include <salma/drivers/CSerialLine.h>

#include <cmath>
#include <stdexcept>

#include "CSickPort.h"
#include "steadyNow.h"

IMPLEMENTS_GENERIC_SENSOR(CLms200, salma::drivers)

namespace salma::drivers {
namespace {

using mrpt::obs::CObservation2DRangeScan;

constexpr double beamAperture = 0.25;  // deg; SICK, "LMS 200 Technical Description": 4.4 mrad

}  // namespace

CLms200::CLms200() {
    setLoggerName("CLms200");
    m_state = ssUninitialized;
    m_sensorLabel = m_options.sensorLabel;  // loadConfig() keeps it where the section names none
}

CLms200::~CLms200() = default;  // CSickLaserSerial tells the laser to stop

void CLms200::loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& file,
                                        const std::string& section) {
    setLoggerName(section);
    TLms200Options options;
    try {
        options.loadFromConfigFile(file, section);
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(config::withoutBrackets(error.what()));
    }
    setOptions(options);
}

void CLms200::setOptions(const TLms200Options& options) {
    options.validate();
    m_options = options;
    setSerialPort(absolutePort(m_options.port));
    setBaudRate(m_options.baud);
    setMillimeterMode(m_options.mmMode);
    setScanFOV(m_options.fieldOfView);
    setScanResolution(m_options.resolution);
}

void CLms200::initialize() {
    connect();
    MRPT_LOG_INFO_STREAM("laser found at " << m_options.port);
}

void CLms200::connect() {
    disconnect();
    m_state = ssInitializing;
    m_port = std::make_shared<CSickPort>(getSerialPort());
    bindIO(m_port);  // always a fresh one: CSickLaserSerial takes an open port for a laser set up
    try {
        CSickLaserSerial::initialize();
        if (!m_port->problem().empty()) throw std::runtime_error(m_port->problem());
    } catch (const std::exception&) {  // MRPT's text is a call stack, or empty
        const std::string problem = m_port->problem();
        disconnect();
        throw CPortError(!problem.empty() ? problem
                                          : getSerialPort() +
                                                ": no LMS 200 answers there as it should, at any "
                                                "rate");
    }
    m_port->claim();
    m_lastScan = steadyNow();
    m_state = ssWorking;
}

void CLms200::disconnect() {
    if (m_port) m_counts.badTelegrams += m_port->counts().badTelegrams;
    m_port.reset();
    bindIO(nullptr);
}

void CLms200::doProcess() {
    if (!m_port) return reconnect();
    do {
        auto scan = CObservation2DRangeScan::Create();
        bool thereIsScan = false, error = false;
        doProcessSimple(thereIsScan, *scan, error);
        if (thereIsScan) appendObservation(scan);
    } while (m_port && m_port->waiting());
}

void CLms200::doProcessSimple(bool& thereIsScan,
                              CObservation2DRangeScan& scan,
                              bool& hardwareError) {
    thereIsScan = hardwareError = false;
    if (!m_port) return;
    CSickLaserSerial::doProcessSimple(thereIsScan, scan, hardwareError);
    if (!m_port->problem().empty()) {
        lost(m_port->problem());
    } else if (thereIsScan && scan.getScanSize() != m_options.beams()) {
        lost(m_options.port + ": the laser sends " + std::to_string(scan.getScanSize()) +
             " readings, FOV and resolution make " + std::to_string(m_options.beams()));
    } else if (thereIsScan) {
        correct(scan);
        ++m_counts.scans;
        m_lastScan = steadyNow();
        return;
    } else if (steadyNow() - m_lastScan > m_options.silence) {
        lost(m_options.port + ": no scan for " + std::to_string(m_options.silence) + " s");
    }
    thereIsScan = false;
    hardwareError = !m_port;
}

void CLms200::correct(CObservation2DRangeScan& scan) const {
    scan.timestamp = mrpt::Clock::fromDouble(m_port->began() - m_options.latency);
    scan.aperture = static_cast<float>(m_options.aperture());
    scan.beamAperture = static_cast<float>(mrpt::DEG2RAD(beamAperture));
    scan.stdError =
        static_cast<float>(std::hypot(m_options.rangeSigma, m_options.quantum() / std::sqrt(12.0)));
    scan.sensorPose =
        mrpt::poses::CPose3D(m_options.x, m_options.y, m_options.z, mrpt::DEG2RAD(m_options.yaw),
                             mrpt::DEG2RAD(m_options.pitch), mrpt::DEG2RAD(m_options.roll));
    for (std::size_t i = 0; i < scan.getScanSize(); ++i) {
        const float range = scan.getScanRange(i);
        const bool valid = range > 0 && range <= scan.maxRange;
        if (!valid) scan.setScanRange(i, 0);
        scan.setScanRangeValidity(i, valid);
    }
}

void CLms200::reconnect() {
    if (!m_reconnection.due()) return;
    try {
        connect();
        m_reconnection.found();
        ++m_counts.reconnections;
        MRPT_LOG_WARN_STREAM("laser found again at " << m_options.port);
    } catch (const CPortError& error) {
        lost(error.what());
    }
}

void CLms200::lost(const std::string& problem) {
    m_state = ssError;
    if (m_reconnection.lost(problem, m_options.reconnectTime))
        MRPT_LOG_ERROR_STREAM("laser lost: " << problem);
    disconnect();  // last: `problem` may be the port's own
}

TLms200Counts CLms200::counts() const {
    TLms200Counts counts = m_counts;
    if (m_port) counts.badTelegrams += m_port->counts().badTelegrams;
    return counts;
}

}  // namespace salma::drivers
