// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/core/bits_math.h>
#include <salma/config/TStrictOptions.h>
#include <salma/drivers/TGrabberKeys.h>
#include <salma/drivers/TViscaOptions.h>

#include <string>

namespace salma::drivers {

/** A section of a rawlog-grabber ini file: what MRPT itself reads there, the port, the camera, and
 * where head and camera are mounted. Angles [rad], lengths [m]. */
struct TPanTiltCameraOptions : public config::TStrictOptions<TPanTiltCameraOptions>,
                               public TGrabberKeys {
    TPanTiltCameraOptions() : TGrabberKeys("CPanTiltCameraSensor", "HEAD", 10) {}

    struct TMount {
        double x{0}, y{0}, z{0}, yaw{0}, pitch{0}, roll{0};
    };

    std::string port{"/dev/ttyS0"};
    TViscaOptions camera;
    int zoomEvery{10};        //!< The zoom is asked for with each so-manyth record.
    double reconnectTime{1};  //!< Between attempts to reach a camera that was lost [s].
    TMount base;              //!< T_r_b.
    TMount cameraOnHead{0, 0, 0, mrpt::DEG2RAD(-90.0), 0, mrpt::DEG2RAD(-90.0)};  //!< T_h_c.

    void visit(config::COptionVisitor& visitor);
    /// \throw std::invalid_argument naming the key.
    void validate() const;
};

}  // namespace salma::drivers
