// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <salma/laser/CLineExtractor.h>
#include <salma/observations/TPlaceString.h>

#include <vector>

namespace salma::laser {

/// Section [place_string] of config.ini.
struct TPlaceStringOptions : public config::TStrictOptions<TPlaceStringOptions> {
    double minWall{0.3};                   //!< Shorter lines are no walls [m].
    double recess{0.35};                   //!< A wall goes on past niches as deep as this [m].
    double maxGap{1.2};                    //!< And past things in front as wide as this [m].
    double cornerReach{0.35};              //!< Both walls end this near to a corner [m].
    double minAngle{mrpt::DEG2RAD(30.0)};  //!< Between the walls of a corner [rad].
    double minJump{0.3};                   //!< Of the range, at a jump edge [m].
    double minOpening{0.5};                //!< Narrower ways between walls are none [m].
    double maxOpening{6};                  //!< Nor are wider ones [m].
    int noReturn{4};                       //!< Beams in a row without echo that make an X.
    double attributeSigma{0.05};           //!< Least sigma of a length or width [m].
    double hiddenSigma{1};                 //!< Of a wall whose end is out of sight [m] ...
    double hiddenShare{0.5};               //!< ... or this share of its length, if more.

    void visit(config::COptionVisitor& v);
};

/** Turns a scan into a place string: walls, the corners and jump edges between them, openings wide
 * enough to go through, and where nothing came back, from right to left.
 *
 * A wall is one letter in spite of niches (shut doors) and things before it; its sigma says whether
 * its ends were seen. An opening is the shortest way from a jump edge to a wall on the far side, so
 * that doors and side ways have their true width from any side. Const is safe from several threads.
 * Source: own; the idea of strings of scan features is in K.-L. Ho, transfer report, Oxford 2004,
 * section 4.7. */
class CPlaceString {
 public:
    /// \throw std::invalid_argument if an option is out of range.
    explicit CPlaceString(const TPlaceStringOptions& options = {});

    /** \param lines Of the same scan.
     * \return Empty if nothing straight is seen. */
    observations::TPlaceString describe(const mrpt::obs::CObservation2DRangeScan& scan,
                                        const TLineResult& lines) const;

    const TPlaceStringOptions& options() const { return m_options; }

 private:
    TPlaceStringOptions m_options;
};

}  // namespace salma::laser
