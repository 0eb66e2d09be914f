// SPDX-License-Identifier: BSD-3-Clause
#include "drawing.h"

#include <mrpt/opengl/stock_objects.h>

namespace salma::observations::drawing {

void insertAxes(mrpt::opengl::CSetOfObjects& objects,
                const mrpt::poses::CPose3D& pose,
                float length,
                const std::string& name) {
    auto axes = mrpt::opengl::stock_objects::CornerXYZSimple(length, 2.0F);
    axes->setPose(pose);
    if (!name.empty()) {
        axes->setName(name);
        axes->enableShowName();
    }
    objects.insert(axes);
}

}  // namespace salma::observations::drawing
