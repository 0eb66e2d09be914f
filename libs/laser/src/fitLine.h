// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "beams.h"

namespace salma::laser {

/// Indices of beams, in order.
using Members = std::vector<std::uint32_t>;

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
    /// Variance of distance() from the beam's noise [m^2].
    double variance(const TBeam& b, const TBeamNoise& noise) const {
        const double t = along(b) * noise.bearing;
        const double q = (b.cosine * cosine + b.sine * sine) * noise.range;
        return q * q + t * t;
    }
};

/// Line through two beams' ends; nothing if they coincide.
std::optional<TFit> lineThrough(const TBeam& a, const TBeam& b);

/** One step of weighted total least squares, which minimises sum (distance / sigma)^2 by
 * Gauss-Newton. For refinement whose members change after each step; leaves the covariance alone.
 * \return Nothing if the points do not determine a line. */
std::optional<TFit> improveLine(const TFit& start,
                                const std::vector<TBeam>& beams,
                                const Members& members,
                                const TBeamNoise& noise);

/** The same until it stands still, with the covariance, which is widened where the points scatter
 * clearly more than the noise says.
 * \param members Indices into `beams`, at least 3 and not all in one place.
 * \return Nothing if the points do not determine a line. */
std::optional<TFit> refineLine(const TFit& start,
                               const std::vector<TBeam>& beams,
                               const Members& members,
                               const TBeamNoise& noise);

}  // namespace salma::laser
