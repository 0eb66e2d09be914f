// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/slam/TRunRecord.h>

#include <optional>

namespace salma::slam {

/// How far off the camera's focal length seems to be.
struct TFocalCheck {
    std::size_t sightings{0};  //!< That it rests on.
    double error{0};           //!< Focal length as used over the true one, less 1.
    double sigma{0};           //!< Standard deviation of the error, from the scatter about the fit.

    /// True if the error is too large to be chance, and to be left unsaid.
    bool isWrong() const;
};

/** What the map says of the intrinsics with which its salient landmarks were seen.
 *
 * With a focal length that is too long by the share e, a point at the angle a to the right of the
 * camera's axis seems to lie e sin(a) cos(a) too near to the axis. A landmark that is seen in
 * several columns of the picture therefore has bearings that disagree by their columns, whatever
 * its own place: e is the slope of the bearings' residuals, less their mean over the landmark, over
 * sin(a) cos(a), less its mean. The laser's corners hold the trajectory meanwhile. The slope comes
 * out up to a third too small where the trajectory follows the posters instead. Source: own.
 *
 * \return Nothing where the salient landmarks were seen too seldom, or always in one column. */
std::optional<TFocalCheck> checkFocalLength(const TRunRecord& record);

}  // namespace salma::slam
