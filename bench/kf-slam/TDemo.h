// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint3D.h>

#include <string>
#include <vector>

namespace salma::bench {

/// One of the range-bearing logs that come with MRPT, and what is true of it.
struct TDemo {
    std::string rawlog;
    std::vector<mrpt::math::TPoint3D> path;       //!< By frame of the log [m].
    std::vector<mrpt::math::TPoint3D> landmarks;  //!< [m]

    /// \param stem The log without `.rawlog`; its truth stands beside it.
    /// \throw std::runtime_error if a file is missing or has no rows of three numbers.
    static TDemo read(const std::string& stem);
};

/// What a filter made of it.
struct TDemoRun {
    std::vector<mrpt::math::TPoint3D> path;
    std::vector<mrpt::math::TPoint3D> landmarks;
    double seconds{0};  //!< Processor time of all steps.
};

struct TDemoScore {
    std::size_t landmarks{0};
    std::size_t duplicates{0};  //!< Landmarks whose nearest true one is that of another.
    double pathRms{0};          //!< Of the positions, in the frame of the first pose [m].
    double landmarkRms{0};      //!< To the nearest true landmark [m].
    double millisecondsPerStep{0};
};

/// \throw std::invalid_argument if the run has neither as many steps as the truth nor one less.
TDemoScore score(const TDemo& demo, const TDemoRun& run);

}  // namespace salma::bench
