// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <salma/laser/CLineExtractor.h>

#include <cstddef>
#include <vector>

namespace salma::laser {

/// One reading, about the scanner's place but along the robot's axes.
struct TBeam {
    double cosine{1}, sine{0};  //!< Direction.
    double range{0};            //!< [m]; 0 if the reading cannot be used.
    double x{0}, y{0};          //!< End of the beam [m].
    std::size_t index{0};       //!< In the record.

    bool valid() const { return range > 0; }
};

/// All readings counter-clockwise; fills the counts, the sensor's place and `tilted`.
std::vector<TBeam> readBeams(const mrpt::obs::CObservation2DRangeScan& scan,
                             double maxRange,
                             TLineResult& result);

}  // namespace salma::laser
