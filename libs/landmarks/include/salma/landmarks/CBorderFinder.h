// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>

#include <opencv2/core.hpp>
#include <optional>

namespace salma::landmarks {

/// Section [border] of config.ini.
struct TBorderOptions : public config::TStrictOptions<TBorderOptions> {
    double grow{0.8};       //!< How far a side may lie outside the start rectangle [m].
    double shrink{0.12};    //!< How far inside [m].
    double quantile{0.35};  //!< This share of a side may lack contrast [-].
    double contrast{2.5};   //!< Grey levels per pixel that the rest of the side must change by.
    double dominance{0.5};  //!< The nearest edge counts if it has this share of the best contrast.
    double prominence{1.5};  //!< A side's contrast over that of the lines between two sides.

    void visit(config::COptionVisitor& v);
};

/** Finds the border of an upright rectangle, such as a poster, in a picture of a wall.
 *
 * A side of a poster is a straight upright or level line across which the grey level changes
 * nearly everywhere, which texture inside a painting hardly ever is. So the salient regions only
 * have to hit the poster, and its extent does not depend on which of them were found: a landmark's
 * position is as repeatable as its border. Source: own. */
class CBorderFinder {
 public:
    /// \throw std::invalid_argument if the options are out of range.
    explicit CBorderFinder(const TBorderOptions& options = {});

    /** \param wall Grey picture of the wall as seen from straight ahead, CV_8UC1.
     * \param valid Same size, CV_8UC1, 0 where `wall` is not known.
     * \param start Rectangle inside or around which the border is sought [px of `wall`].
     * \param pixelsPerMetre Resolution of `wall`, > 0.
     * \return The border [px of `wall`]; nothing if one of the four sides is not found. */
    std::optional<cv::Rect2d> find(const cv::Mat& wall,
                                   const cv::Mat& valid,
                                   const cv::Rect2d& start,
                                   double pixelsPerMetre) const;

    const TBorderOptions& options() const { return m_options; }

 private:
    TBorderOptions m_options;
};

}  // namespace salma::landmarks
