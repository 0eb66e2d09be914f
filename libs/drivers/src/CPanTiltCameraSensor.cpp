// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/Clock.h>
#include <salma/config/withoutBrackets.h>
#include <salma/drivers/CPanTiltCameraSensor.h>
#include <salma/drivers/CViscaCamera.h>

#include <stdexcept>
#include <string>

IMPLEMENTS_GENERIC_SENSOR(CPanTiltCameraSensor, salma::drivers)

namespace salma::drivers {
namespace {

using mrpt::poses::CPose3D;
using observations::CObservationPanTilt;

constexpr double historyLength = 10;  // seconds; a picture does not wait that long for its pose

CPose3D poseOf(const TPanTiltCameraOptions::TMount& mount) {
    return {mount.x, mount.y, mount.z, mount.yaw, mount.pitch, mount.roll};
}

}  // namespace

CPanTiltCameraSensor::CPanTiltCameraSensor() : mrpt::system::COutputLogger("CPanTiltCameraSensor") {
    m_state = ssUninitialized;
    m_sensorLabel = m_options.sensorLabel;  // loadConfig() keeps it where the section names none
}

CPanTiltCameraSensor::~CPanTiltCameraSensor() = default;

void CPanTiltCameraSensor::loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& file,
                                                     const std::string& section) {
    setLoggerName(section);
    try {
        m_options.loadFromConfigFile(file, section);
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(config::withoutBrackets(error.what()));
    }
}

void CPanTiltCameraSensor::initialize() {
    connect();
    MRPT_LOG_INFO_STREAM("camera found at " << m_options.port);
}

void CPanTiltCameraSensor::connect() {
    m_state = ssInitializing;
    m_camera = std::make_unique<CViscaCamera>(m_options.port, m_options.camera);
    m_recordsUntilZoom = 0;
    m_state = ssWorking;
}

void CPanTiltCameraSensor::doProcess() {
    if (!m_camera) return reconnect();
    try {
        record();
    } catch (const std::runtime_error& error) {
        m_camera.reset();
        lost(error.what());
    }
}

void CPanTiltCameraSensor::reconnect() {
    if (!m_reconnection.due()) return;
    try {
        connect();
        m_reconnection.found();
        MRPT_LOG_WARN_STREAM("camera found again at " << m_options.port);
    } catch (const std::runtime_error& error) {
        lost(error.what());
    }
}

void CPanTiltCameraSensor::lost(const std::string& problem) {
    m_state = ssError;
    if (m_reconnection.lost(problem, m_options.reconnectTime))
        MRPT_LOG_ERROR_STREAM("camera lost: " << problem);
}

void CPanTiltCameraSensor::pointTo(double pan, double tilt, double speed) {
    const TViscaOptions& camera = m_options.camera;
    if (!(pan >= camera.panMin && pan <= camera.panMax && tilt >= camera.tiltMin &&
          tilt <= camera.tiltMax && speed > 0 && speed <= camera.panMaxSpeed))
        throw std::invalid_argument("the head cannot turn there, or not so fast");
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_goal = TGoal{pan, tilt, speed};
}

void CPanTiltCameraSensor::move() {
    std::optional<TGoal> goal;
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        goal.swap(m_goal);
    }
    if (!goal) return;
    try {
        m_camera->moveTo(goal->pan, goal->tilt, goal->speed);
    } catch (const CViscaError& error) {  // where it stands is known all the same
        if (m_refusal != error.what()) MRPT_LOG_WARN_STREAM("not turned: " << error.what());
        m_refusal = error.what();
    }
}

void CPanTiltCameraSensor::record() {
    move();
    const TPanTiltSample sample = m_camera->panTilt();
    if (m_recordsUntilZoom == 0) {
        m_zoom = m_camera->zoom();
        m_recordsUntilZoom = m_options.zoomEvery;
    }
    --m_recordsUntilZoom;
    auto state = CObservationPanTilt::Create();
    state->sensorLabel = m_sensorLabel;
    state->timestamp = mrpt::Clock::fromDouble(sample.time);
    state->pan = sample.pan;
    state->tilt = sample.tilt;
    state->zoom = m_zoom;
    state->basePose = poseOf(m_options.base);
    state->cameraOnHead = poseOf(m_options.cameraOnHead);
    remember(state);
    appendObservation(state);
}

void CPanTiltCameraSensor::remember(const CObservationPanTilt::Ptr& state) {
    const std::lock_guard<std::mutex> lock(m_mutex);
    try {
        m_history.add(state);
    } catch (const std::invalid_argument&) {  // the clock was set back: older stamps mean nothing
        MRPT_LOG_WARN("the clock jumped back; poses of the camera before that are forgotten");
        m_history = {};
        m_history.add(state);
    }
    m_history.forgetBefore(mrpt::Clock::toDouble(state->timestamp) - historyLength);
}

std::optional<CPose3D> CPanTiltCameraSensor::cameraPose(const mrpt::Clock::time_point& time,
                                                        double maxSkew) const {
    const std::lock_guard<std::mutex> lock(m_mutex);
    return m_history.cameraPose(mrpt::Clock::toDouble(time), maxSkew);
}

bool CPanTiltCameraSensor::stamp(mrpt::obs::CObservation& picture, double maxSkew) const {
    const auto pose = cameraPose(picture.timestamp, maxSkew);
    if (pose) picture.setSensorPose(*pose);
    return pose.has_value();
}

}  // namespace salma::drivers
