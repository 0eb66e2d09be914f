// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace salma::slam {

/// How far a scanner saw in each direction.
struct TLaserView {
    Eigen::Vector3d sensor{0, 0, 0};  //!< (x, y, yaw) in the robot frame of the step [m, rad].
    double first{0};                  //!< Direction of the first beam, from the sensor's yaw [rad].
    double spacing{0};                //!< From one beam to the next, counter-clockwise [rad].
    /// By beam [m]; infinite where nothing came back. Null: none.
    std::shared_ptr<const std::vector<float>> free;

    /** Share of the beams towards a point that reach it.
     * \param point Robot frame [m]. \param slack A beam may end so much before it [m].
     * \param spread Beams that pass it nearer than this count; at least the nearest two [m].
     * \return 1 where the scanner does not look, or without beams: nothing is known to be hidden.
     */
    double reaching(const Eigen::Vector2d& point, double slack, double spread) const;

    /// True if the point, robot frame [m], lies in the scanner's field.
    bool looksAt(const Eigen::Vector2d& point) const;

    /// Of the field, from the sensor's yaw; with `free` only [rad].
    double middle() const { return first + 0.5 * spacing * (double(free->size()) - 1); }
    /// From there to the outer border of the outermost beams; with `free` only [rad].
    double halfField() const { return 0.5 * spacing * double(free->size()); }
};

/// Where a camera looked.
struct TCameraView {
    Eigen::Vector3d camera{0, 0,
                           0};  //!< (x, y, direction of its axis) in the robot frame [m, rad].
    double halfField{0};        //!< From its axis to the border of the picture [rad].
    std::size_t mostPosters{std::numeric_limits<std::size_t>::max()};  //!< Taken from a picture.
};

/// Where a step's sensors looked.
struct TViews {
    std::optional<TLaserView> laser;    //!< The last scan, if it is recent.
    bool scanned{false};                //!< It belongs to this step: corners were looked for.
    std::optional<TCameraView> camera;  //!< Posters were looked for there. None: no picture.
};

}  // namespace salma::slam
