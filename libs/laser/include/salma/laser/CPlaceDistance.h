// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>
#include <salma/observations/TPlaceString.h>

#include <limits>
#include <vector>

namespace salma::laser {

/// Section [place_distance] of config.ini.
struct TPlaceDistanceOptions : public config::TStrictOptions<TPlaceDistanceOptions> {
    double gap{3};           //!< Cost of a letter that only one string has, in sigmas.
    double shortWall{1};     //!< A wall shorter than this costs less, in proportion [m].
    double freeShare{0.25};  //!< Share of the shorter string that may stick out at each end.

    void visit(config::COptionVisitor& v);
};

/** How far two places differ: the edit distance of their strings.
 *
 * Changing a letter into the same letter costs the Mahalanobis distance of the attributes; letters
 * of different kinds are never exchanged. At each end up to `free_share` of the shorter string's
 * letters stick out at no cost (semi-global alignment): the field of view ends somewhere else when
 * the robot has turned. Two rows of memory; const is safe from several threads.
 * Source: own; S. Needleman and C. Wunsch, J. Mol. Biol. 48, 1970, with free ends. */
class CPlaceDistance {
 public:
    /// \throw std::invalid_argument if an option is out of range.
    explicit CPlaceDistance(const TPlaceDistanceOptions& options = {});

    /** Share of all letters' cost, in [0, 1]: 0 for equal strings, 1 if nothing is shared; two
     * empty strings are equal.
     * \param limit A distance above this is only told to be so: infinity is returned. */
    double operator()(const observations::TPlaceString& a,
                      const observations::TPlaceString& b,
                      double limit = std::numeric_limits<double>::infinity()) const;

    const TPlaceDistanceOptions& options() const { return m_options; }

    /// Cost of leaving out a letter [sigmas].
    double gapCost(const observations::TPlaceLetter& letter) const;

    /// Cost of taking `a` for `b` [sigmas]; infinity for different kinds.
    static double changeCost(const observations::TPlaceLetter& a,
                             const observations::TPlaceLetter& b);

 private:
    TPlaceDistanceOptions m_options;
};

}  // namespace salma::laser
