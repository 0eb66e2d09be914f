// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "beams.h"

namespace salma::laser {

/// Noise of one reading.
struct TBeamNoise {
    double range{0};    //!< [m]
    double bearing{0};  //!< [rad]
};

/// A line in the frame of the beams, without ends.
struct TFit {
    double rho{0};     //!< >= 0 [m].
    double cosine{1};  //!< Of alpha.
    double sine{0};
    Eigen::Matrix2d covariance{Eigen::Matrix2d::Zero()};  //!< Of (rho, alpha) [m, rad].

    double distance(const TBeam& b) const { return b.x * cosine + b.y * sine - rho; }
    double along(const TBeam& b) const { return b.y * cosine - b.x * sine; }
    /// Standard deviation of distance() from the beam's noise [m].
    double sigma(const TBeam& b, const TBeamNoise& noise) const {
        const double t = along(b);
        const double q = (b.x * cosine + b.y * sine) / b.range * noise.range;
        return std::sqrt(q * q + t * t * noise.bearing * noise.bearing);
    }
};

/// Line through two beams' ends; nothing if they coincide.
std::optional<TFit> lineThrough(const TBeam& a, const TBeam& b);

/** Weighted total least squares: minimises sum (distance / sigma)^2 by Gauss-Newton from `start`.
 * The covariance is widened where the points scatter clearly more than the noise says.
 * \param members Indices into `beams`, at least 3 and not all in one place.
 * \return Nothing if the points do not determine a line. */
std::optional<TFit> refineLine(const TFit& start,
                               const std::vector<TBeam>& beams,
                               const std::vector<std::size_t>& members,
                               const TBeamNoise& noise);

}  // namespace salma::laser
