// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/appearance/CRectifier.h>

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace salma::bench {

/// What the front end made of one view.
struct TSeenView {
    std::size_t poster{0};
    /// Corners of the selected rectangle in the picture, put on the wall by the true geometry: top
    /// left, top right, bottom right, bottom left, from the poster's centre [m]. Nothing: refused.
    std::optional<Eigen::Matrix<double, 2, 4>> corners;
    Eigen::Vector2d half{0, 0};  //!< Half of the poster's width and height [m].
    Eigen::Matrix<double, 6, 1> error{Eigen::Matrix<double, 6, 1>::Zero()};  //!< Of the pose.
    Eigen::Matrix<double, 6, 6> covariance{Eigen::Matrix<double, 6, 6>::Identity()};
    std::size_t falseEntities{0};  //!< Landmarks whose centre lies beside the poster.
    double seconds{0};             //!< That the front end took.
    double distance{0}, incidence{0};
};

/// A share with its 95 % interval from drawing whole posters anew.
struct TShare {
    std::size_t hits{0}, of{0};
    double low{0}, high{0};
    double value() const { return of > 0 ? static_cast<double>(hits) / of : 0; }
};

/// The figures of one detector.
struct TDetectorFigures {
    TShare selected;    //!< Views in which the poster is selected.
    TShare nearTruth;   //!< Of these, all four corners within 5 cm of the poster's.
    TShare nearMedian;  //!< Of these, all within 5 cm of the median rectangle of the poster.
    TShare wholly;      //!< Of all views, selected and near the truth.
    double falsePerView{0};
    double milliseconds{0};     //!< Per picture, mean.
    double nees6{0}, nees3{0};  //!< Mean of all six, and of (x, y, yaw); all selected views.
    double nees3Near{0};        //!< The same of views near the truth.
    std::size_t count{0}, countNear{0};
    double medianSideError{0};  //!< Median over all corners and axes of the absolute error [m].
};

/// Sums up what a detector made of all views. \param posters In the set.
TDetectorFigures figuresOf(const std::vector<TSeenView>& views, std::size_t posters);

}  // namespace salma::bench
