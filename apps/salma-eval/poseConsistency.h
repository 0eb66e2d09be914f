// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/slam/TRunRecord.h>
#include <salma/viz/TTrajectory.h>

#include <cstdint>
#include <vector>

namespace salma::apps {

/** Error of the estimated pose against its own covariance, over a run.
 *
 * The filter starts at a pose that it takes for certain, so errors are those in the frame of the
 * first pose of the run: no alignment takes part of them away. */
struct TPoseConsistency {
    /// The run is looked at in so many parts of equal time; `at` has their ends.
    static constexpr std::size_t kParts = 20;

    double meanNees{0};      //!< Over the steps with a regular covariance; NaN without any.
    std::uint64_t steps{0};  //!< Number of these steps.
    std::vector<double> at;  //!< [kParts], NEES of the last regular step in each part, else NaN.
    double finalError{0};    //!< Of the last position [m]; NaN without steps.
    double maxJump{0};       //!< Largest growth of the error of position within a step [m].
};

/** Normalised estimation error squared, e' P^-1 e with e = (x, y, heading), which has mean 3 for
 * a consistent filter. Steps whose covariance is singular, as before the first motion, are not
 * counted; steps without a true pose within `maxGap` [s] are not looked at.
 * Source: Y. Bar-Shalom, X. R. Li and T. Kirubarajan, Estimation with Applications to Tracking and
 * Navigation, 2001, section 5.4. */
TPoseConsistency poseConsistency(const slam::TRunRecord& record,
                                 const viz::TTrajectory& truth,
                                 double maxGap);

}  // namespace salma::apps
