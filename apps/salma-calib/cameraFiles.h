// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/TCamera.h>
#include <mrpt/poses/CPose3D.h>

#include <string>

namespace salma::apps {

/// Section [CAMERA_PARAMS] as MRPT's programs read it (rawlog-edit --camera-params LABEL,FILE).
std::string cameraSection(const mrpt::img::TCamera& camera);

/// The same camera as YAML in the layout of ROS, which mrpt::img::TCamera::FromYAML reads too.
std::string cameraYaml(const mrpt::img::TCamera& camera, const std::string& name);

/// A section `label` as rawlog-grabber and rawlog-edit --sensors-pose read it: pose_x ... pose_roll
/// of the sensor on the robot [m, deg].
std::string sensorSection(const std::string& label, const mrpt::poses::CPose3D& T_r_s);

/// \throw std::runtime_error naming the file
void writeFile(const std::string& file, const std::string& text);

/// `digits` behind the point; "-" for NaN.
std::string fixed(double value, int digits);

}  // namespace salma::apps
