// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "CGatedStep.h"
#include "CWhitener.h"

namespace salma::association {

/** The terms of a hypothesis' score, and what they can become at best.
 *
 *   L = sum over pairings [ log P_found + log LR + log N(innovation | the pairings before it) ]
 *     + sum over landmarks in view without measurement  log(1 - P_D)
 *     + sum over measurements without landmark  log lambda_new or log lambda_clutter.
 *
 * Unpaired landmarks count log(1 - P_D) in every hypothesis, so the score is kept relative to the
 * hypothesis without any pairing: a pairing gains log P_found - log(1 - P_D).
 *
 * However many pairings a hypothesis has, it does not know a landmark better than from all other
 * landmarks that could be paired, each seen with the smallest noise of its measurements. What this
 * leaves is a floor for covariances and so a bound for densities, sharper than R alone. */
template <int DIM>
class CHypothesisScore {
 public:
    /// What pairing a landmark gains over leaving it without measurement:
    /// log P_found - log(1 - P_D).
    static double detectionGain(const TAssociationOptions& options,
                                const TPredictedLandmarkOf<DIM>& landmark);

    /// \param branches Pairs of open measurements, sorted; all must be pairs of `step`.
    CHypothesisScore(const TAssociationOptions& options,
                     const TAssociationProblemOf<DIM>& problem,
                     const CGatedStep<DIM>& step,
                     const std::vector<TBranch>& branches);

    /// What appearance and detection add to a branch's log density.
    double gain(std::size_t branch) const { return m_terms[branch].gain; }
    /// Largest gain + log density in any hypothesis.
    double bound(std::size_t branch) const { return m_terms[branch].bound; }
    /// Of the smallest covariance of the innovation in any hypothesis that does not contain the
    /// branch; nothing where it is not sound.
    /// \param landmarkToo The hypothesis may pair the landmark with another measurement.
    const std::optional<CWhitener<DIM>>& floor(std::size_t branch, bool landmarkToo) const {
        return landmarkToo ? m_terms[branch].lowest : m_terms[branch].floor;
    }

    /// Log density of a measurement that shows a landmark which is not in the map, or nothing.
    double unexplained(std::size_t observation) const;
    double clutter(std::size_t observation) const;

 private:
    struct TTerms {
        double gain{0};
        double bound{0};
        std::optional<CWhitener<DIM>> floor, lowest;
    };
    void setBounds(const std::vector<TBranch>& branches, const std::vector<TBranch>& given);

    const TAssociationOptions& m_options;
    const TAssociationProblemOf<DIM>& m_problem;
    std::vector<TTerms> m_terms;
};

}  // namespace salma::association
