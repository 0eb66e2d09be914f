// SPDX-License-Identifier: BSD-3-Clause
#include "CPtzApp.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/core/format.h>
#include <salma/config/CStrictFile.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace salma::apps {
namespace {

using drivers::CViscaCamera;
using drivers::TPanTiltCameraOptions;
using mrpt::DEG2RAD;
using mrpt::RAD2DEG;

void printState(CViscaCamera& camera, std::ostream& out) {
    const auto head = camera.panTilt();
    const double zoom = camera.zoom();
    out << mrpt::format(
        "pan   %8.2f deg\ntilt  %8.2f deg\nzoom  %8.2f, %d counts\nfield %8.2f deg\n",
        RAD2DEG(head.pan), RAD2DEG(head.tilt), zoom, camera.options().zoom.counts(zoom),
        RAD2DEG(camera.fieldOfView(zoom)));
}

}  // namespace

CPtzApp::CPtzApp(CLI::App& app) {
    app.add_option("DEVICE", m_device, "serial port, absolute or below /dev");
    app.add_option("--config", m_config, "ini file of rawlog-grabber with the camera's section");
    app.add_option("--section", m_section, "that section")->capture_default_str();
    app.add_flag("--print-config", m_printConfig, "print the section that would be used, and stop");
    app.require_subcommand(0, 1);
    app.fallthrough();
    app.add_subcommand("status", "where the camera looks");
    addMove(app);
    m_zoomTo = app.add_subcommand("zoom", "change the focal length");
    m_zoomTo->add_option("FACTOR", m_zoom, "over the shortest focal length; 1: not zoomed")
        ->required();
    m_home = app.add_subcommand("home", "look ahead");
    m_stop = app.add_subcommand("stop", "stop where it is");
    app.callback([this, &app] {
        if (m_printConfig) return;
        if (m_device.empty()) throw CLI::RequiredError("DEVICE");
        if (app.get_subcommands().empty())
            throw CLI::RequiredError("A subcommand, status, move, zoom, home or stop,");
    });
}

void CPtzApp::addMove(CLI::App& app) {
    m_move = app.add_subcommand("move", "turn the head");
    m_move->add_option("PAN_DEG", m_panDegrees, "positive to the left")->required();
    m_move->add_option("TILT_DEG", m_tiltDegrees, "positive upwards")->required();
    m_move->add_flag("--relative", m_relative, "from where it looks now");
    m_move->add_option("--speed", m_speedDegrees, "degrees a second (default: the fastest)");
}

TPanTiltCameraOptions CPtzApp::options() const {
    TPanTiltCameraOptions options;
    if (!m_config.empty()) {
        const auto file = config::openStrict(m_config);
        std::vector<std::string> sections;
        file->getAllSections(sections);
        if (std::find(sections.begin(), sections.end(), m_section) == sections.end())
            throw std::invalid_argument(m_config + ": has no section [" + m_section + "]");
        options.loadFromConfigFile(*file, m_section);
    }
    if (!m_device.empty()) options.port = m_device;
    return options;
}

void CPtzApp::run(std::ostream& out) {
    const auto effective = options();
    if (m_printConfig) {
        out << effective.asIni(m_section);
        return;
    }
    CViscaCamera camera(effective.port, effective.camera);
    command(camera);
    camera.wait();
    printState(camera, out);
}

void CPtzApp::command(CViscaCamera& camera) const {
    if (m_move->parsed()) {
        const double pan = DEG2RAD(m_panDegrees), tilt = DEG2RAD(m_tiltDegrees);
        const double speed =
            m_move->count("--speed") > 0 ? DEG2RAD(m_speedDegrees) : camera.options().panMaxSpeed;
        m_relative ? camera.moveBy(pan, tilt, speed) : camera.moveTo(pan, tilt, speed);
    } else if (m_zoomTo->parsed()) {
        camera.setZoom(m_zoom);
    } else if (m_home->parsed()) {
        camera.home();
    } else if (m_stop->parsed()) {
        camera.stop();
    }
}

}  // namespace salma::apps
