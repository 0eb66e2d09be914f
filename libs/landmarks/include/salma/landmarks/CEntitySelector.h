// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/appearance/CRectifier.h>
#include <salma/appearance/CWallView.h>
#include <salma/config/TStrictOptions.h>
#include <salma/observations/TSalientRegion.h>

#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

namespace salma::landmarks {

/// What entities are made of; see CEntityDetector.
enum class EDetector { scaleSaliency, mser, both, quad, external };

/// Section [selection] of config.ini.
struct TSelectionOptions : public config::TStrictOptions<TSelectionOptions> {
    EDetector detector{EDetector::both};
    double brightness{110};  //!< Mean grey to which darker pictures are brought first; 0: none.
    double yMin{1.9};        //!< Salient regions below this are not looked at [nat].
    int minRegions{2};       //!< Regions that make an entity.
    double touch{2.0};    //!< Two regions touch if their centres are nearer than this times the sum
                          //!< of their scales.
    int maxEntities{3};   //!< Landmarks taken from one picture.
    int maxTries{4};      //!< Entities looked at until there are so many.
    double lowest{0.3};   //!< Regions whose centre lies lower above the floor are refused [m].
    double highest{2.6};  //!< And higher ones [m].
    double wallMargin{0.1};  //!< How far beyond the end of a laser line the wall is believed [m].
    double samePlane{0.05};  //!< Two laser lines nearer than this are one plane [m].

    void visit(config::COptionVisitor& v);
};

/// What a detector found in a picture, before walls are known.
struct TDetections {
    std::vector<observations::TSalientRegion> regions;  //!< [px]; Y = 0 if the detector has none.
    std::vector<std::vector<cv::Point>> areas;  //!< Regions inside one of them belong together.
};

/// A salient thing on a wall, before its border is known.
struct TEntity {
    std::size_t wall{0};                                //!< Index into the walls.
    appearance::TWallRectangle box;                     //!< Around the regions, wall metres.
    std::vector<observations::TSalientRegion> regions;  //!< [px]
    double saliency{0};                                 //!< Sum of their Y.
};

/// Entities, and what became of the other regions.
struct TSelection {
    std::vector<TEntity> entities;  //!< The one with most regions first.
    std::size_t notFinite{0};       //!< Regions without a place in the picture or without size.
    std::size_t onNoWall{0};        //!< Regions where the laser sees no wall.
    std::size_t outOfHeight{0};     //!< Regions too low or too high on their wall.
    std::size_t tooFewRegions{0};   //!< Groups smaller than `min_regions`.
    std::size_t split{0};           //!< Groups that lay on several planes and were split.
};

/** Joins regions to entities on walls and ranks them by the number of regions.
 *
 * Regions are joined if their discs touch or if they lie in one area; a group that lies on several
 * laser planes is split, so that every entity lies on one. Ties are decided by the sum of Y, then
 * by the size on the wall, then by place.
 * Source: K.-L. Ho, transfer report, Oxford 2004, section 4.1.2. */
class CEntitySelector {
 public:
    /// \throw std::invalid_argument if the options are out of range.
    explicit CEntitySelector(const TSelectionOptions& options = {});

    /// \param walls The walls that the laser sees, each with this picture.
    TSelection select(const TDetections& found,
                      const std::vector<appearance::CWallView>& walls) const;

    const TSelectionOptions& options() const { return m_options; }

 private:
    TSelectionOptions m_options;
};

/** The wall that a pixel shows: the nearest that its ray meets.
 * \param margin How far beyond the end of its line a wall is believed [m].
 * \return Its index, or walls.size() if there is none. */
std::size_t wallOf(const mrpt::math::TPoint2D& pixel,
                   const std::vector<appearance::CWallView>& walls,
                   double margin);

}  // namespace salma::landmarks
