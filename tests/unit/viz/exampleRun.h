// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/slam/TRunRecord.h>
#include <salma/viz/TTrajectory.h>

namespace salma::test {

struct TExampleRun {
    slam::TRunRecord record;
    viz::TTrajectory truth;
};

/** A made-up run as a robot might leave it: two laps of a rectangular hallway, 20 m x 10 m along
 * its middle, six posters, corners, an estimate whose covariance grows until the loop is closed.
 * The truth is 1 m east of the estimate's frame. */
TExampleRun hallwayRun();

/// A salient landmark at (x, y) with a patch of 0.6 m x 0.4 m: white, its top left quarter black.
slam::TMapLandmark posterAt(double x, double y, double wallAngle);

}  // namespace salma::test
