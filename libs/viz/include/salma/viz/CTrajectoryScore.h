// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>
#include <salma/viz/TTrajectory.h>

#include <cstddef>
#include <vector>

namespace salma::viz {

struct TScoreOptions : public config::TStrictOptions<TScoreOptions> {
    double maxGap{0.5};      //!< Longest gap between two reference poses to interpolate over [s].
    double deltaMetres{1};   //!< Distance on the reference that relative errors span [m].
    double deltaSeconds{1};  //!< Time that relative errors span [s].

    void visit(config::COptionVisitor& v);
    /// \throw std::invalid_argument unless each is positive and finite.
    void validate() const;
};

/// Of a set of errors; zeros for an empty set.
struct TErrorFigures {
    double rmse{0}, mean{0}, max{0};
    std::size_t count{0};
};

struct TRelativeError {
    TErrorFigures translation;  //!< [m]
    TErrorFigures rotation;     //!< [rad]
};

struct TTrajectoryFigures {
    std::size_t pairs{0};               //!< Estimated poses with a reference pose.
    std::size_t unmatched{0};           //!< Estimated poses without one.
    double referenceLength{0};          //!< Path length of the reference at the pairs [m].
    mrpt::poses::CPose2D T_ref_est;     //!< The alignment [m, rad].
    TErrorFigures aligned;              //!< Absolute trajectory error after alignment [m].
    TErrorFigures unaligned;            //!< The same without alignment [m].
    TErrorFigures alignedHeading;       //!< Absolute error of the heading after alignment [rad].
    TRelativeError perMetres, perTime;  //!< Relative pose error per delta.
};

/** Absolute and relative trajectory error in SE(2).
 *
 * Each estimated pose is compared with the reference interpolated at its stamp. The alignment is
 * the rotation and translation (no scale) that bring the estimated positions nearest to the
 * reference's. A relative error spans from a pose to the first later one at least a delta away.
 * Source: S. Umeyama, IEEE PAMI 13(4), 1991 (alignment); J. Sturm et al., "A benchmark for the
 * evaluation of RGB-D SLAM systems", IROS 2012, eqs. 1-6 (RPE, ATE). */
class CTrajectoryScore {
 public:
    /// \throw std::invalid_argument if the options are out of range.
    explicit CTrajectoryScore(const TScoreOptions& options = {});

    /// \throw std::invalid_argument if fewer than two estimated poses have a reference pose.
    TTrajectoryFigures compare(const TTrajectory& reference, const TTrajectory& estimate) const;

 private:
    TScoreOptions m_options;
};

/** The pose at time `t`, interpolated linearly (heading along the shorter turn).
 * \return False if `t` lies more than 1 us outside of the trajectory, or in a gap longer than
 * `maxGap` [s]. */
bool interpolate(const TTrajectory& trajectory,
                 double t,
                 double maxGap,
                 mrpt::poses::CPose2D& pose);

/** Rotation and translation that bring the positions of `from` nearest to those of `to`, pose by
 * pose, as T_to_from. Both must be of one size; the identity rotation if all points coincide. */
mrpt::poses::CPose2D alignment(const std::vector<mrpt::poses::CPose2D>& from,
                               const std::vector<mrpt::poses::CPose2D>& to);

}  // namespace salma::viz
