// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace salma::landmarks {

/// Section [border] of config.ini.
struct TBorderOptions : public config::TStrictOptions<TBorderOptions> {
    double grow{0.8};        //!< How far a side may lie outside the regions [m].
    double contrast{2.5};    //!< Grey levels per pixel by which an edge changes.
    double support{0.65};    //!< This share of a side shows an edge, at least [-].
    double nearBest{0.9};    //!< The largest rectangle wins that is this good, of the best.
    double inside{0.9};      //!< This share of the regions lies inside [-].
    double sameWall{20};     //!< Outside of all four sides the wall is equally bright within this.
    double difference{0.3};  //!< Hellinger distance of in- and outside that says nothing [-].
    double sideSigma{0.01};  //!< Error of a side's place, for the covariance of the centre [m].
    double separation{0.4};  //!< Share of the border that tells inside from outside, at least [-].

    void visit(config::COptionVisitor& v);
};

/** Finds the border of an upright rectangle, such as a poster, in a picture of a wall.
 *
 * All rectangles of straight upright and level lines around the regions are compared. Each side of
 * a poster is an edge nearly everywhere and ends at its corners, which lines of brick or a door do
 * not; and the same wall goes on outside all four sides, which it does not where a line inside the
 * painting is taken for a side. Of several such rectangles (a frame, a mat, the painting) the
 * outermost counts. So an extent does not depend on which regions were found. Source: own. */
class CBorderFinder {
 public:
    /// \throw std::invalid_argument if the options are out of range.
    explicit CBorderFinder(const TBorderOptions& options = {});

    /** \param wall Grey picture of the wall as seen from straight ahead, CV_8UC1.
     * \param valid Same size, CV_8UC1, 0 where `wall` is not known.
     * \param regions Centres of the salient regions [px of `wall`].
     * \param pixelsPerMetre Resolution of `wall` along its rows and columns, > 0.
     * \return The border [px of `wall`]; nothing if no rectangle passes, or without regions. */
    std::optional<cv::Rect2d> find(const cv::Mat& wall,
                                   const cv::Mat& valid,
                                   const std::vector<cv::Point2d>& regions,
                                   const cv::Point2d& pixelsPerMetre) const;

    const TBorderOptions& options() const { return m_options; }

 private:
    TBorderOptions m_options;
};

}  // namespace salma::landmarks
