// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/slam/CPathHistory.h>
#include <salma/slam/blockFilter.h>

#include <Eigen/Core>
#include <vector>

namespace salma::slam {

/// The most likely path and map.
struct TSmoothed {
    std::vector<Eigen::Vector3d> poses;  //!< After each step (x, y, heading), world [m, rad].
    Eigen::VectorXd mean;                //!< Last pose, then (x, y) of each landmark [3 + 2N].
    RowMatrix covariance;                //!< Of `mean`; empty if it was not asked for.
    std::vector<double> misfit;          //!< By landmark, mean of its squared normalised residuals.
    double cost{0};                      //!< Sum of the squared normalised residuals.
    int iterations{0};
    bool converged{false};
};

/** Estimates the whole path and map anew from all that was measured, by Levenberg-Marquardt.
 *
 * Where the extended Kalman filter keeps the derivatives of the moment at which it took a
 * measurement, all are taken here at the result, again and again. So a loop may be closed after a
 * heading error of tens of degrees. The normal equations are sparse (each measurement ties one pose
 * to one landmark); the covariance of the last pose and all landmarks is that of their inverse.
 * Source: Dellaert and Kaess, IJRR 25(12), 2006 (square root SAM); for joining maps by
 * relinearisation: Estrada, Neira and Tardos, IEEE T-RO 21(4), 2005. */
class CPathSmoother {
 public:
    explicit CPathSmoother(int maxIterations = 100);

    /** \param history Its poses are where the iteration starts.
     * \param ids Of the landmarks, in the order of the result.
     * \param start Their places to start from, world [m].
     * \param withCovariance It takes as long as the rest.
     * \throw std::invalid_argument if a measurement is of another landmark, or a landmark has none.
     * \throw std::runtime_error if the normal equations cannot be solved. */
    TSmoothed smooth(const CPathHistory& history,
                     const std::vector<int>& ids,
                     const std::vector<Eigen::Vector2d>& start,
                     bool withCovariance = true) const;

 private:
    int m_maxIterations;
};

}  // namespace salma::slam
