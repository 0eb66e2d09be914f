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

/// Section [selection] of config.ini.
struct TSelectionOptions : public config::TStrictOptions<TSelectionOptions> {
    double yMin{1.9};     //!< Regions less salient than this are not looked at [nat].
    int minRegions{2};    //!< Clustered regions that make an entity.
    double touch{2.0};    //!< Two regions touch if their centres are nearer than this times the sum
                          //!< of their scales.
    int maxEntities{1};   //!< Entities taken from one picture.
    double lowest{0.3};   //!< Regions whose centre lies lower above the floor are refused [m].
    double highest{2.6};  //!< And higher ones [m].
    double wallMargin{0.1};  //!< How far beyond the end of a laser line the wall is believed [m].
    double samePlane{0.05};  //!< Two laser lines nearer than this are one plane [m].

    void visit(config::COptionVisitor& v);
};

/// A salient thing on a wall, before its border is known.
struct TEntity {
    std::size_t wall{0};                                //!< Index into the walls.
    appearance::TWallRectangle box;                     //!< Around the regions, wall metres.
    std::vector<observations::TSalientRegion> regions;  //!< Its clustered regions [px].
    double saliency{0};                                 //!< Sum of their Y.
};

/// Entities, and what became of the other regions.
struct TSelection {
    std::vector<TEntity> entities;  //!< The one with most regions first; at most `max_entities`.
    std::size_t belowThreshold{0};  //!< Regions with Y < y_min.
    std::size_t onNoWall{0};  //!< Regions where the laser sees no wall, or too low, or too high.
    std::size_t tooFewRegions{0};  //!< Groups smaller than `min_regions`.
    std::size_t outnumbered{0};    //!< Groups beyond `max_entities`.
};

/** Joins salient regions to entities on walls and takes the one with most regions.
 *
 * Regions are joined if their discs touch or if they lie in one stable region, and only if they lie
 * on one laser plane. Ties are decided by the sum of Y, then by place.
 * Source: K.-L. Ho, transfer report, Oxford 2004, section 4.1.2. */
class CEntitySelector {
 public:
    /// \throw std::invalid_argument if the options are out of range.
    explicit CEntitySelector(const TSelectionOptions& options = {});

    /** \param regions Clustered salient regions of one picture [px].
     * \param stable Pixels of each maximally stable region of the picture [px]; may be empty.
     * \param walls The walls that the laser sees, each with this picture. */
    TSelection select(const std::vector<observations::TSalientRegion>& regions,
                      const std::vector<std::vector<cv::Point>>& stable,
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
