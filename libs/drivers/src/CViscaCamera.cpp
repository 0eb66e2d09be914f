// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/format.h>
#include <salma/drivers/CViscaCamera.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "CViscaLink.h"

namespace salma::drivers {
namespace {

using mrpt::DEG2RAD;
using mrpt::RAD2DEG;
using visca::TPanTiltCounts;

void checkAngle(const char* name, double angle, double min, double max) {
    constexpr double rounding = 1e-9;  // limits that went through degrees
    if (!(angle >= min - rounding && angle <= max + rounding))
        throw std::invalid_argument(mrpt::format("%s %g deg is outside [%g, %g] deg", name,
                                                 RAD2DEG(angle), RAD2DEG(min), RAD2DEG(max)));
}

const TViscaOptions& valid(const TViscaOptions& options) {
    options.validate();
    return options;
}

bool nearTo(const TPanTiltCounts& a, const TPanTiltCounts& b) {
    constexpr int tolerance = 2;  // what is given back may be rounded differently
    return std::abs(a.pan - b.pan) <= tolerance && std::abs(a.tilt - b.tilt) <= tolerance;
}

}  // namespace

CViscaCamera::CViscaCamera(const std::string& port, const TViscaOptions& options)
    : m_options(valid(options)), m_link(std::make_unique<CViscaLink>(port, options)) {}

CViscaCamera::~CViscaCamera() = default;

TPanTiltSample CViscaCamera::panTilt() {
    const auto answer = m_link->inquire(
        visca::panTiltInquiry(m_options.address),
        [](const TViscaReply& reply) {
            return reply.kind == EViscaReply::information && visca::decodePanTilt(reply.data);
        },
        true);
    const auto head = *visca::decodePanTilt(answer.reply.data);
    TPanTiltSample sample;
    sample.pan = DEG2RAD(head.pan / m_options.panCounts);
    sample.tilt = DEG2RAD(head.tilt / m_options.tiltCounts);
    sample.time = (answer.sent + answer.reply.began) / 2;
    sample.uncertainty = std::max(answer.reply.began - sample.time, sample.time - answer.asked);
    return sample;
}

int CViscaCamera::zoomCounts() {
    const auto answer =
        m_link->inquire(visca::zoomInquiry(m_options.address), [](const TViscaReply& reply) {
            return reply.kind == EViscaReply::information && visca::decodeZoom(reply.data);
        });
    return *visca::decodeZoom(answer.reply.data);
}

double CViscaCamera::zoom() { return m_options.zoom.factor(zoomCounts()); }

visca::TSpeed CViscaCamera::speedBytes(double speed) const {
    if (!(speed > 0 && speed <= m_options.panMaxSpeed * (1 + 1e-9)))
        throw std::invalid_argument(mrpt::format("speed %g deg/s is outside (0, %g] deg/s",
                                                 RAD2DEG(speed), RAD2DEG(m_options.panMaxSpeed)));
    const auto byte = [speed](double maxSpeed, int maxByte) {
        const double part = std::min(1.0, speed / maxSpeed);
        return std::max(1, static_cast<int>(std::lround(part * maxByte)));
    };
    return {byte(m_options.panMaxSpeed, visca::maxPanSpeed),
            byte(m_options.tiltMaxSpeed, visca::maxTiltSpeed)};
}

TPanTiltCounts CViscaCamera::counts(double pan, double tilt) const {
    return {static_cast<int>(std::lround(RAD2DEG(pan) * m_options.panCounts)),
            static_cast<int>(std::lround(RAD2DEG(tilt) * m_options.tiltCounts))};
}

void CViscaCamera::moveTo(double pan, double tilt, double speed) {
    checkAngle("pan", pan, m_options.panMin, m_options.panMax);
    checkAngle("tilt", tilt, m_options.tiltMin, m_options.tiltMax);
    const auto bytes = speedBytes(speed);
    m_headTarget = counts(pan, tilt);
    m_link->start(visca::panTiltAbsolute(m_options.address, bytes, *m_headTarget), true);
}

void CViscaCamera::moveBy(double pan, double tilt, double speed) {
    const auto bytes = speedBytes(speed);
    const TPanTiltSample now = panTilt();
    checkAngle("pan", now.pan + pan, m_options.panMin, m_options.panMax);
    checkAngle("tilt", now.tilt + tilt, m_options.tiltMin, m_options.tiltMax);
    const TPanTiltCounts step = counts(pan, tilt);
    const TPanTiltCounts from = counts(now.pan, now.tilt);
    m_headTarget = TPanTiltCounts{from.pan + step.pan, from.tilt + step.tilt};
    m_link->start(visca::panTiltRelative(m_options.address, bytes, step), false);
}

void CViscaCamera::home() {
    m_headTarget = TPanTiltCounts{0, 0};
    m_link->start(visca::panTiltHome(m_options.address), true);
}

void CViscaCamera::setZoom(double zoom) {
    if (!(zoom >= 1 && zoom <= m_options.zoom.maxFactor() * (1 + 1e-9)))
        throw std::invalid_argument(
            mrpt::format("zoom %g is outside [1, %g]", zoom, m_options.zoom.maxFactor()));
    m_zoomTarget = m_options.zoom.counts(zoom);
    m_link->start(visca::zoomDirect(m_options.address, *m_zoomTarget), true);
}

CViscaCamera::TPlace CViscaCamera::place() {
    const TPanTiltSample head = panTilt();
    return {counts(head.pan, head.tilt), zoomCounts()};
}

bool CViscaCamera::isThere(const TPlace& place) const {
    return (!m_headTarget || nearTo(place.head, *m_headTarget)) &&
           (!m_zoomTarget || std::abs(place.zoom - *m_zoomTarget) <= 2);
}

void CViscaCamera::wait() {
    std::optional<TPlace> before;
    bool arrived = true;
    while (m_link->isBusy()) {
        if (m_link->waitForEnd(m_options.stallTime)) continue;
        const TPlace now = place();
        const bool stands = before && before->head == now.head && before->zoom == now.zoom;
        before = now;
        if (!m_link->isBusy() || !stands) continue;
        m_link->forgetRunning();
        arrived = isThere(now);
    }
    for (const int failure : m_link->takeFailures()) {
        if (failure != visca::cancelled) m_link->fail(failure);
        arrived = arrived && isThere(place());  // replaced by a later command, or taken from us
    }
    if (!arrived)
        throw CViscaError(m_link->port() + ": camera " + std::to_string(m_options.address) +
                              ": it stopped short of where it was sent",
                          visca::cancelled);
}

void CViscaCamera::stop() {
    m_link->cancelAll();
    m_headTarget.reset();
    m_zoomTarget.reset();
}

}  // namespace salma::drivers
