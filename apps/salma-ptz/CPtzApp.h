// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/drivers/CViscaCamera.h>
#include <salma/drivers/TPanTiltCameraOptions.h>

#include <CLI/CLI.hpp>
#include <ostream>
#include <string>

namespace salma::apps {

/** salma-ptz: one command to a camera, and where it stands afterwards.
 *
 * Adds its arguments and subcommands to `app` and keeps what they were given. */
class CPtzApp {
 public:
    /// `app` may parse only while this object lives.
    explicit CPtzApp(CLI::App& app);
    CPtzApp(const CPtzApp&) = delete;
    CPtzApp& operator=(const CPtzApp&) = delete;

    /// Does what the command line asked for.
    /// \throw std::invalid_argument, drivers::CPortError, drivers::CViscaError
    void run(std::ostream& out);

 private:
    void addMove(CLI::App& app);
    /// The section of --config, or the defaults, with DEVICE in place of its port.
    drivers::TPanTiltCameraOptions options() const;
    void command(drivers::CViscaCamera& camera) const;

    CLI::App* m_move{nullptr};
    CLI::App* m_zoomTo{nullptr};
    CLI::App* m_home{nullptr};
    CLI::App* m_stop{nullptr};
    std::string m_device, m_config, m_section{"HEAD"};
    double m_panDegrees{0}, m_tiltDegrees{0}, m_speedDegrees{0}, m_zoom{1};
    bool m_relative{false}, m_printConfig{false};
};

}  // namespace salma::apps
