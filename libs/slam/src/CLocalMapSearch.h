// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/slam/CRelocator.h>

#include <cstddef>
#include <vector>

#include "CPrints.h"

namespace salma::slam {

/// One attempt of CRelocator.
class CLocalMapSearch {
 public:
    CLocalMapSearch(const TRelocationOptions& options,
                    const CDetectionModel& detection,
                    const TRelocationInput& input,
                    double since,
                    TRatioCache& ratios);

    /// The best alignment and its margin; without pairs if there is none.
    TRelocation run();
    /// Both maps as they lie.
    TAlignment asTheyLie(const TAlignment& before);

 private:
    /// A landmark of either map.
    struct TMark {
        std::size_t index{0};  //!< In the table.
        Eigen::Vector2d place{0, 0};
        std::size_t firstStep{0}, lastStep{0};
    };
    using TMarks = std::vector<TMark>;
    /// Of the history, the first and the one after the last.
    struct TSteps {
        std::size_t from{0}, to{0};
    };

    void split(double since);
    bool salient(const TMark& mark) const;
    bool mayBeOne(const TMark& local, const TMark& left, double turn) const;
    double ratio(const TMark& local, const TMark& left);
    double ratioAmongLookAlikes(const TMark& local, const TMark& left);
    void findLookAlikes();

    std::vector<Eigen::Vector3d> proposals();
    bool inReach(const TMark& local, const TMark& left) const;

    std::vector<TAlignment> aligned(Eigen::Vector3d T);
    std::vector<TAlignment> passes(const TAlignment& alignment) const;
    bool isOf(const TAlignment& alignment, const TMark& left) const;
    double travelOf(std::size_t step) const { return m_input.history[step].travel; }
    std::vector<TSameLandmark> matched(const Eigen::Vector3d& T, double radius);
    /// Covariance of (local after the turn - left) of all pairs [2n x 2n].
    Eigen::MatrixXd covarianceOf(const std::vector<TSameLandmark>& pairs, double turn) const;
    bool dropIncompatible(TAlignment& alignment) const;

    void weighPosters(TAlignment& alignment);
    void weighCorners(TAlignment& alignment) const;
    void weighOdometry(TAlignment& alignment) const;
    double missed(const TMark& mark, const Eigen::Vector3d& T, const TSteps& steps) const;
    bool cornerWasLookedAt(const Eigen::Vector2d& place, const TSteps& steps) const;
    TSteps leftSteps(const TAlignment& alignment) const;
    TSteps localSteps() const { return {m_localStart, m_input.history.size()}; }
    bool sameMotion(const TAlignment& a, const TAlignment& b) const;
    static bool samePass(const TAlignment& a, const TAlignment& b);

    const TRelocationOptions& m_options;
    const CDetectionModel& m_detection;
    const TRelocationInput& m_input;
    TRatioCache& m_ratios;
    TMarks m_local, m_left;
    CPrints m_prints;
    std::size_t m_localStart{0};         //!< First step that used a landmark of the local map.
    std::vector<std::size_t> m_glances;  //!< Scans, thinned by travel.
};

}  // namespace salma::slam
