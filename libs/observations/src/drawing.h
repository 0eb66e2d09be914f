// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/poses/CPose3D.h>

#include <string>

namespace salma::observations::drawing {

/// Axes of `length` [m] (x red, y green, z blue) at `pose`, with a name unless that is empty.
void insertAxes(mrpt::opengl::CSetOfObjects& objects,
                const mrpt::poses::CPose3D& pose,
                float length,
                const std::string& name);

}  // namespace salma::observations::drawing
