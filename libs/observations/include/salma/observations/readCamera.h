// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/TCamera.h>

#include <string>

namespace salma::observations {

/** The camera of a section [CAMERA_PARAMS], as salma-calib writes it and MRPT's programs read it
 * (rawlog-edit --camera-params LABEL,FILE), but read strictly.
 * \throw std::invalid_argument naming file, key and value. */
mrpt::img::TCamera readCamera(const std::string& file);

}  // namespace salma::observations
