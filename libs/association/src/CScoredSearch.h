// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <optional>
#include <utility>

#include "CChiSquareGate.h"
#include "CHypothesisScore.h"

namespace salma::association {

/// Pairings and their score, relative to the hypothesis without any.
struct TScoredHypothesis {
    std::vector<std::size_t> branches;  //!< Sorted indices of the tree's branches.
    double score{-std::numeric_limits<double>::infinity()};

    bool exists() const { return score > -std::numeric_limits<double>::infinity(); }
};

/// A measurement that geometry and appearance allow to be near a landmark.
struct TExplainable {
    std::size_t observation{0};
    std::vector<std::size_t> near;      //!< Branches that a new landmark must be clear of.
    std::vector<std::size_t> pairable;  //!< Of these, those inside the individual gate.
};

/// What a hypothesis must be like.
struct TSearchGoal {
    static constexpr std::size_t nothing = std::numeric_limits<std::size_t>::max();

    double threshold{-std::numeric_limits<double>::infinity()};  //!< Its score is larger.
    bool any{false};  //!< The first one will do; else the best one is wanted.
    std::size_t withoutBranch{nothing};
    std::size_t pairedRow{nothing};  //!< Index of a measurement that it must pair.
};

/// Branch and bound for the hypothesis with the largest score inside the joint gate.
template <int DIM>
class CScoredSearch {
 public:
    /// All must outlive this object. \param newDistance2 What is nearer to a landmark is not new.
    CScoredSearch(CInterpretationTree<DIM>& tree,
                  const CHypothesisScore<DIM>& score,
                  const CChiSquareGate& gate,
                  double newDistance2);

    void add(TExplainable row) { m_all.push_back(std::move(row)); }
    const std::vector<TExplainable>& rows() const { return m_all; }

    /// \param lastTest The search ends when the tree counts so many tests.
    TScoredHypothesis find(const TSearchGoal& goal, std::size_t lastTest);
    /// False if the last search did not end by itself.
    bool isComplete() const { return m_complete; }

 private:
    /// Where the hypotheses below can take a branch. They shift its innovation, which costs them a
    /// squared distance theta: up to now + sqrt(excess * theta) from the landmark, in units of
    /// floor.
    struct TReach {
        double now{std::numeric_limits<double>::infinity()};
        double excess{std::numeric_limits<double>::infinity()};
        double nearest2{0};  //!< Least squared distance, in units of any covariance.
    };
    /// A measurement on the way down.
    struct TRow {
        const TExplainable* what{nullptr};
        bool left{false};                    //!< Without landmark in all hypotheses below.
        std::vector<std::size_t> survivors;  //!< Pairable branches, the most likely first.
        double lead{0};       //!< Of the best survivor over the next explanation, given the path.
        double bestCase{0};   //!< Largest contribution to the score in hypotheses below.
        double bestAlone{0};  //!< The same if it is not paired.
        double clutter{0};    //!< What it contributes if it is near a landmark and not paired.
        double clearCost{0};  //!< Least theta at which it can be clear of all landmarks.
        bool surelyClear{false};
        std::optional<std::size_t> rejected;  //!< The best branch that it could be paired with.
        double rejectedPeak{0};               //!< Its gain + log density for no innovation.
        TReach rejectedReach;
    };
    using TRows = std::vector<TRow>;
    /// What the hypotheses below can have.
    struct TProspect {
        double room{0};                   //!< Largest theta that the joint gate allows.
        std::vector<std::size_t> claims;  //!< By landmark, measurements that may be paired with it.
    };

    void explore(const TRows& rows);
    bool isOver();
    bool promises(const TRows& rows) const;
    double bound(const TRows& rows, double leastTheta) const;
    static double costOf(const TReach& reach, double distance);
    void rate(const std::vector<std::pair<double, std::size_t>>& likely,
              double room,
              TRow& row) const;
    double boundWithout(const TRow& left, const TRows& rows) const;
    TRow judged(const TRow& row, TProspect& prospect);
    TRows judged(const TRows& rows);
    TReach reach(std::size_t branch, const TBranchTest& tested, const TProspect& prospect) const;
    void weigh(const TRows& rows);
    double aloneScore(const TExplainable& row);

    CInterpretationTree<DIM>& m_tree;
    const CHypothesisScore<DIM>& m_score;
    const CChiSquareGate& m_gate;
    double m_newDistance2;
    std::size_t m_landmarks{0};  //!< Above all indices of landmarks.
    std::vector<TExplainable> m_all;
    TSearchGoal m_goal;
    std::size_t m_lastTest{0};
    bool m_complete{true};
    std::vector<std::size_t> m_path;
    double m_pathScore{0};
    TScoredHypothesis m_best;
};

}  // namespace salma::association
