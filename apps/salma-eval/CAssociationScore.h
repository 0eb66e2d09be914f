// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/slam/TRunRecord.h>

#include <cstddef>
#include <map>
#include <vector>

#include "proportion.h"

namespace salma::apps {

/// An observation was paired with a landmark that stands for another true landmark.
struct TWrongPairing {
    double time{0};  //!< [s since 1970]
    std::size_t observation{0};
    int landmark{0};          //!< Of the run.
    int landmarkTruth{0};     //!< What that landmark really is.
    int observationTruth{0};  //!< What was really seen.
};

/// A true landmark that stands in the run's map more than once.
struct TDuplicate {
    int truth{0};
    std::vector<int> landmarks;
};

/// How one kind of landmark was associated.
struct TAssociationFigures {
    std::size_t observations{0};
    std::size_t falseEntities{0};      //!< Observations of no true landmark.
    TProportion precision;             //!< Pairings that are right, of those that can be judged.
    TProportion recall;                //!< Sightings of landmarks already mapped that were paired
                                       //!< rightly.
    std::vector<TWrongPairing> wrong;  //!< Between two different true landmarks.
    std::size_t wrongWithFalse{0};     //!< Pairings of a true landmark with a false one.
    std::size_t unjudged{0};       //!< Pairings of false with false, or with an unknown landmark.
    std::size_t deferred{0};       //!< Sightings of landmarks already mapped that were deferred.
    std::size_t trueLandmarks{0};  //!< In the world.
    std::size_t landmarksMade{0};  //!< By the run.
    std::size_t landmarksCovered{0};  //!< True landmarks that the run has at least once.
    std::size_t falseLandmarks{0};    //!< Landmarks of the run that are no true landmark.
    std::vector<TDuplicate> duplicates;

    /// Landmarks of the run beyond the first of each true landmark.
    std::size_t duplicateLandmarks() const;
};

/** Keeps the books over the observations of a run, in their order in time.
 *
 * A landmark of the run is what its first observation really was. A sighting is "of a landmark
 * already mapped" if that landmark was made in an earlier step. */
class CAssociationScore {
 public:
    /// \param truth Id of the true landmark that was seen; -1 for none.
    void add(const slam::TAssociationRow& row, int truth);

    /// \param trueLandmarks Number of landmarks of the kind in the world.
    TAssociationFigures figures(std::size_t trueLandmarks) const;

 private:
    void addLandmark(const slam::TAssociationRow& row, int truth);
    /// True if the pairing is right.
    bool judge(const slam::TAssociationRow& row, int truth);

    TAssociationFigures m_figures;
    std::size_t m_right{0}, m_resightings{0}, m_recalled{0};
    std::map<int, int> m_truthOf;                   //!< Landmark of the run to true landmark.
    std::map<int, std::vector<int>> m_landmarksOf;  //!< True landmark to those of the run.
    std::map<int, double> m_mappedSince;            //!< True landmark to time [s].
};

}  // namespace salma::apps
