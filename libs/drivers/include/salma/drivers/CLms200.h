// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/hwdrivers/CSickLaserSerial.h>
#include <salma/drivers/CReconnection.h>
#include <salma/drivers/TLms200Options.h>

#include <cstddef>
#include <memory>
#include <string>

namespace salma::drivers {

class CSickPort;

/// What a laser has delivered since the program began.
struct TLms200Counts {
    std::size_t scans{0};
    std::size_t badTelegrams{0};  //!< Broken off or corrupted on the line; each costs one scan.
    std::size_t reconnections{0};
};

/** MRPT's driver of the SICK LMS 200, with what it gets wrong put right.
 *
 * Speaks with the laser through CSickLaserSerial. Different: the aperture of a scan is that of its
 * field of view (MRPT: always 180 deg); a range of 0 or beyond the mode is invalid and 0; stdError
 * and beamAperture are those of the device; the stamp is when the first byte came, less `latency_s`
 * (MRPT: when the last was read, up to 0.8 s later); corrupted bytes cannot reach MRPT's buffers
 * (CSickPort); a laser that sends other scans than it was told to is an error. A laser that does
 * not answer when the program starts is an error; one that is lost later is told once, looked for
 * every `reconnect_s`, set up anew and carried on with. No preview window, no exclusion zones. */
class CLms200 : public mrpt::hwdrivers::CSickLaserSerial {
    DEFINE_GENERIC_SENSOR(CLms200)

 public:
    CLms200();
    ~CLms200() override;

    /// \throw CPortError naming the port and what is wrong
    void initialize() override;
    /// All scans that have come, or an attempt to find the laser again; throws nothing for a lost
    /// laser.
    void doProcess() override;
    /// One scan, if there is one.
    void doProcessSimple(bool& thereIsScan,
                         mrpt::obs::CObservation2DRangeScan& scan,
                         bool& hardwareError) override;

    /// In place of loadConfig(), before initialize(). \throw std::invalid_argument
    void setOptions(const TLms200Options& options);

    TLms200Counts counts() const;
    const TLms200Options& options() const { return m_options; }

 protected:
    /// \throw std::invalid_argument naming section, key and value
    void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& file,
                                   const std::string& section) override;

 private:
    void connect();
    void disconnect();
    void reconnect();
    void lost(const std::string& problem);
    void correct(mrpt::obs::CObservation2DRangeScan& scan) const;

    TLms200Options m_options;
    std::shared_ptr<CSickPort> m_port;  //!< Empty while the laser is lost.
    double m_lastScan{0};               //!< By the steady clock [s].
    CReconnection m_reconnection;
    TLms200Counts m_counts;
};

}  // namespace salma::drivers
