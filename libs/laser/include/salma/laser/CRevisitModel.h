// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>
#include <salma/laser/CPlaceFilter.h>

#include <cstddef>
#include <vector>

namespace salma::laser {

/** A Dirichlet prior over how classes of places follow each other, fitted to buildings explored
 * before by the fixed point of the Polya density's likelihood.
 * \param buildings Counts of each building, [class][next class].
 * \return Imagined counts for a new building, all positive: their sum in a row is large where
 * buildings are alike. The uniform prior (0.5 each) for no building.
 * Source: T. Minka, "Estimating a Dirichlet distribution", 2000, equation 65. */
TPlaceMatrix fitPlacePrior(const std::vector<TPlaceMatrix>& buildings);

/// A place of the explored map, entered with a heading.
struct TMapPlace {
    TPlaceVector classes;           //!< Probability of each class there; sum 1.
    std::vector<std::size_t> next;  //!< Places that may come a step later.
    bool exit{false};               //!< From here a step may lead out of the map ...
    bool entry{false};              //!< ... and to here it may lead in.
};

struct TRevisitOptions : public config::TStrictOptions<TRevisitOptions> {
    double outsideAtStart{0.5};  //!< Probability that the robot begins outside the map.
    double leave{0.3};           //!< Probability of a step out of the map, at an exit.
    double enter{0.03};          //!< Probability of a step into the map, from outside.
    double lost{0.001};          //!< Probability of a step inside that the map does not know.
    double evidence{0.5};        //!< Exponent of a scan's probabilities, as in TPlaceFilterOptions.

    void visit(config::COptionVisitor& v);
};

/** How likely it is that the robot is outside the explored map, from the classes of places that it
 * passes.
 *
 * A hidden Markov model. Inside, the state is a place of the map and the map says what comes next.
 * Outside, it is the class of the present place, and the next one follows the Dirichlet prior
 * updated by what was counted in this building: by the map at the start and, softly, outside. One
 * step is some metre of travel or a quarter turn; the same spacing as in the map.
 * Source: Stewart, Ko, Fox and Konolige, UAI 2003 (here exact over places of the map, not by
 * particles); D. Fox, J. Ko, K. Konolige and B. Stewart, ISRR 2003. */
class CRevisitModel {
 public:
    /** \param prior Imagined counts, from fitPlacePrior().
     * \throw std::invalid_argument if an option is out of range, a count is not positive, the map
     * has no entry, or a place names one that does not exist or has no distribution. */
    CRevisitModel(const TRevisitOptions& options,
                  const TPlaceMatrix& prior,
                  std::vector<TMapPlace> map);

    /** One step. \param scan Probabilities of the classes, equally likely before.
     * \return Probability of being outside.
     * \throw std::invalid_argument if a number is negative or not finite, or all are zero. */
    double update(const TPlaceVector& scan);

    double outside() const;

    /// Probability of each place of the map.
    const std::vector<double>& inside() const { return m_inside; }

    /// Probability of each next class outside, as believed now.
    TPlaceMatrix structure() const;

 private:
    TRevisitOptions m_options;
    TPlaceMatrix m_counts;
    std::vector<TMapPlace> m_map;
    std::vector<double> m_inside;
    TPlaceVector m_outside{};
    std::size_t m_entries{0};
    bool m_begun{false};
};

}  // namespace salma::laser
