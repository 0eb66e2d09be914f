// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <salma/config/TStrictOptions.h>

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

namespace salma::calibration {

struct TRobustHomography;

/// How pairs of points with outliers among them are fitted.
struct THomographyOptions : public config::TStrictOptions<THomographyOptions> {
    double maxDistance{3};    //!< [unit of `to`] An inlier lies no farther from where it is mapped.
    double confidence{0.99};  //!< That a sample without outliers was drawn.
    int maxSamples{2000};     //!< At most so many are drawn.
    int minInliers{8};        //!< Fewer are no map: any four pairs agree with each other.

    void visit(config::COptionVisitor& v);
};

/** A map of the projective plane onto another one, and how it is found from pairs of points.
 *
 * Points are of any unit. Nothing is returned where the points determine no invertible map: fewer
 * than four or unequal numbers of them, numbers that are not finite, all or all but one on a line
 * or in one place, or sides that cross so that the map would tear the points apart. Threads: safe.
 */
class CHomography {
 public:
    /** Through four or more pairs, by the direct linear transform.
     *
     * Both sets are normalised (centred, mean distance sqrt 2); the solution is the right singular
     * vector of the smallest singular value. With four pairs it is exact, with more it minimises
     * the algebraic error.
     * Source: R. Hartley and A. Zisserman, "Multiple View Geometry", 2nd ed., algorithm 4.2; K.-L.
     * Ho, transfer report, Oxford 2004, equation 4.7. */
    static std::optional<CHomography> through(const std::vector<mrpt::math::TPoint2D>& from,
                                              const std::vector<mrpt::math::TPoint2D>& to);

    /** From pairs of which some are wrong: RANSAC and Levenberg-Marquardt on the inliers (OpenCV).
     * The same pairs give the same result. */
    static std::optional<TRobustHomography> amongOutliers(
        const std::vector<mrpt::math::TPoint2D>& from,
        const std::vector<mrpt::math::TPoint2D>& to,
        const THomographyOptions& options = {});

    /// Of norm 1, and so that the points it was found from have a positive last coordinate.
    const Eigen::Matrix3d& matrix() const { return m_matrix; }

    /// Where a point goes; infinite on the line that goes to infinity.
    mrpt::math::TPoint2D map(const mrpt::math::TPoint2D& point) const;

 private:
    explicit CHomography(const Eigen::Matrix3d& matrix) : m_matrix(matrix) {}

    Eigen::Matrix3d m_matrix;
};

/// A map found among outliers.
struct TRobustHomography {
    CHomography homography;
    std::vector<bool> inliers;  //!< One for each pair.
    std::size_t count{0};       //!< Of inliers.
};

}  // namespace salma::calibration
