// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/hwdrivers/CGenericSensor.h>
#include <mrpt/system/COutputLogger.h>
#include <salma/drivers/CReconnection.h>
#include <salma/drivers/TPanTiltCameraOptions.h>
#include <salma/observations/CPanTiltHistory.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace salma::drivers {

class CViscaCamera;

/** A pan/tilt camera as a sensor of rawlog-grabber: writes `CObservationPanTilt` at
 * `process_rate`, and says where the camera was when a picture was taken.
 *
 * Records are stamped half way between question and answer. A camera that does not answer when the
 * program starts is an error; one that is lost later (cable, power) is told once, looked for every
 * `reconnect_s`, and goes on when it is back: no record stands for the time between.
 * `cameraPose()`, `stamp()` and `pointTo()` may be called from any thread. */
class CPanTiltCameraSensor : public mrpt::system::COutputLogger,
                             public mrpt::hwdrivers::CGenericSensor {
    DEFINE_GENERIC_SENSOR(CPanTiltCameraSensor)

 public:
    CPanTiltCameraSensor();
    ~CPanTiltCameraSensor() override;

    /// \throw CPortError, CViscaError
    void initialize() override;
    /// One record, or an attempt to find the camera again; throws nothing for a lost camera.
    void doProcess() override;

    /** T_r_c at `time`, from the records of the last ten seconds.
     * \param maxSkew Longest time [s] beyond the first or last record over which it is held. */
    std::optional<mrpt::poses::CPose3D> cameraPose(const mrpt::Clock::time_point& time,
                                                   double maxSkew) const;
    /// Gives `picture` the pose at its own stamp. False, and unchanged, if that is not known.
    bool stamp(mrpt::obs::CObservation& picture, double maxSkew) const;

    /** Turns the head, with the next record; of several wishes before that the last counts. A
     * camera that refuses is told once, and goes on making records. \param speed [rad/s] \throw
     * std::invalid_argument outside the limits of options() */
    void pointTo(double pan, double tilt, double speed);

    const TPanTiltCameraOptions& options() const { return m_options; }

 protected:
    /// \throw std::invalid_argument naming section, key and value
    void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& file,
                                   const std::string& section) override;

 private:
    void connect();
    void reconnect();
    void lost(const std::string& problem);
    void record();
    void move();
    void remember(const observations::CObservationPanTilt::Ptr& state);

    TPanTiltCameraOptions m_options;
    std::unique_ptr<CViscaCamera> m_camera;  //!< Empty while it is lost.
    CReconnection m_reconnection;
    int m_recordsUntilZoom{0};
    double m_zoom{1};
    struct TGoal {
        double pan{0}, tilt{0}, speed{0};
    };
    std::string m_refusal;       //!< Of a motion, that was said last.
    mutable std::mutex m_mutex;  //!< Of what follows.
    observations::CPanTiltHistory m_history;
    std::optional<TGoal> m_goal;
};

}  // namespace salma::drivers
