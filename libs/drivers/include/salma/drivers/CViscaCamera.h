// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/drivers/CViscaError.h>
#include <salma/drivers/TViscaOptions.h>
#include <salma/drivers/viscaPackets.h>

#include <memory>
#include <optional>
#include <string>

namespace salma::drivers {

class CViscaLink;

/// Where the head stood, and when.
struct TPanTiltSample {
    double pan{0};          //!< Positive to the left [rad].
    double tilt{0};         //!< Positive upwards [rad].
    double time{0};         //!< By mrpt::Clock [s]: half way between question and answer.
    double uncertainty{0};  //!< The head stood so at most this long before or after `time` [s].
};

/** Pan, tilt and zoom of a camera that speaks VISCA over a serial port, such as Sony's EVI-D30.
 *
 * Commands return when the camera has begun them; wait() returns when they are done. What got lost
 * on the line is repeated; a camera that was switched off and on is given its address again. For
 * one thread at a time. Each call but fieldOfView() and options() may throw CPortError (port gone)
 * or CViscaError (camera refuses or is silent). Source: ALGORITHMS, section 11; viscaPackets.h. */
class CViscaCamera {
 public:
    /** \param port Absolute path, or a name below /dev.
     * \throw CPortError, CViscaError; std::invalid_argument if an option is out of range */
    explicit CViscaCamera(const std::string& port, const TViscaOptions& options = {});
    ~CViscaCamera();
    CViscaCamera(const CViscaCamera&) = delete;
    CViscaCamera& operator=(const CViscaCamera&) = delete;

    TPanTiltSample panTilt();

    /// Focal length over the shortest one [-].
    double zoom();
    /// Horizontal field of view at a zoom [rad].
    double fieldOfView(double zoom) const { return m_options.zoom.field(zoom); }

    /** Turns the head to `pan`, `tilt` [rad].
     * \param speed Of both axes [rad/s], rounded to the camera's steps; tilt is held to its own
     * maximum.
     * \throw std::invalid_argument beyond the limits, or if `speed` is not in (0, panMaxSpeed] */
    void moveTo(double pan, double tilt, double speed);
    void moveTo(double pan, double tilt) { moveTo(pan, tilt, m_options.panMaxSpeed); }

    /// As moveTo(), from where the head stands. Not sent a second time if no answer comes.
    void moveBy(double pan, double tilt, double speed);
    void moveBy(double pan, double tilt) { moveBy(pan, tilt, m_options.panMaxSpeed); }

    /// Looks ahead, at the camera's own speed.
    void home();

    /// \param zoom In [1, maximum]. \throw std::invalid_argument
    void setZoom(double zoom);

    /** Until all is done that was begun. A report of completion that got lost is made up for by
     * looking whether the head stands where it should.
     * \throw CViscaError also if the camera gave up or stopped short */
    void wait();

    /// Stops where it is.
    void stop();

    const TViscaOptions& options() const { return m_options; }

 private:
    struct TPlace {
        visca::TPanTiltCounts head;
        int zoom{0};
    };

    visca::TSpeed speedBytes(double speed) const;
    visca::TPanTiltCounts counts(double pan, double tilt) const;
    int zoomCounts();
    TPlace place();
    bool isThere(const TPlace& place) const;

    TViscaOptions m_options;
    std::unique_ptr<CViscaLink> m_link;
    std::optional<visca::TPanTiltCounts> m_headTarget;
    std::optional<int> m_zoomTarget;
};

}  // namespace salma::drivers
