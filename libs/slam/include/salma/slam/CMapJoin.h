// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/slam/CPathSmoother.h>
#include <salma/slam/CRelocator.h>

#include <map>
#include <optional>

namespace salma::slam {

/// The run as it is with two maps in one.
struct TJoinedMap {
    CPathHistory history;  //!< Its poses are those that the estimation started from.
    CLandmarkTable landmarks;
    std::map<int, int> keptOf;  //!< By id of a landmark that is gone, the one that it is.
    TSmoothed smoothed;         //!< Its landmarks are those of `landmarks`, in their order.

    /// Index of a landmark of before, which may be gone.
    std::size_t indexOf(int id) const;
};

/// Path and landmarks as a join would have them, before it: each landmark under its own id.
struct TLaidMaps {
    CPathHistory history;
    CLandmarkTable landmarks;
    Eigen::VectorXd mean;  //!< Pose and landmarks [3 + 2N].
};

/** What an alignment would make of a run.
 *
 * Landmarks of both maps become one, and path and map are estimated anew from all that was
 * measured. Source: Estrada, Neira and Tardos, IEEE T-RO 21(4), 2005 (joining by relinearisation).
 */
class CMapJoin {
 public:
    /// \param mean Pose and landmarks [3 + 2N]. All must outlive this object.
    CMapJoin(const CPathHistory& history,
             const CLandmarkTable& landmarks,
             const Eigen::VectorXd& mean)
        : m_history(history), m_landmarks(landmarks), m_mean(mean) {}

    /** The join, without the pairs that do not fit the rest, which are taken out of `alignment`.
     *
     * \return Nothing if too many would have to go: the path does not allow the alignment. */
    std::optional<TJoinedMap> fitting(TAlignment& alignment, bool withCovariance) const;

    TLaidMaps laid(const TJoinedMap& joined) const;

 private:
    TJoinedMap joined(const TAlignment& alignment, bool withCovariance) const;

    const CPathHistory& m_history;
    const CLandmarkTable& m_landmarks;
    const Eigen::VectorXd& m_mean;
};

}  // namespace salma::slam
