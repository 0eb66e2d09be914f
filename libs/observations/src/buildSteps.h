// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/observations/CLogReader.h>

#include "movement.h"
#include "nearestFrames.h"

namespace salma::observations {

/// Contents of a rawlog, taken apart.
struct TLogParts {
    bool actionFormat{false};
    TFrame single;               //!< Observations outside of frames, in the order of the file.
    std::vector<TFrame> frames;  //!< Without empty entries.
    /// Motion up to each frame, where actions state it; as long as `frames`.
    std::vector<std::optional<TMovement>> increments;
};

/// Fills steps, odometry, panTilt, dropped and outOfOrder of `log`. Takes `parts` to pieces.
void buildSteps(TLogParts parts, TLog& log);

}  // namespace salma::observations
