// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/poses/CPose2D.h>
#include <salma/landmarks/CWideBaselineTracker.h>
#include <salma/observations/CObservationSalientLandmarks.h>
#include <salma/sensing/TAttentionOptions.h>
#include <salma/sensing/gazeAt.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace salma::sensing {

/// How far a head turns [rad].
struct TGazeLimits {
    double panMin{0}, panMax{0}, tiltMin{0}, tiltMax{0};
};

/** Decides where the head looks: at an entity that was seen, while the robot drives by, until it
 * has been seen from as many places and directions as a map wants (CWideBaselineTracker); then
 * ahead again. One entity at a time, the first that was seen.
 *
 * Entities are kept in the frame of the odometry, as in salma-slam before it knows better; without
 * odometry in the robot's, which is right while it stands. Source: K.-L. Ho, transfer report,
 * Oxford 2004, section 4.1.2 (provisional landmarks are looked at again); the rest own. */
class CAttention {
 public:
    /// \param ratio See CWideBaselineTracker. \throw std::invalid_argument if options are out of
    /// range
    CAttention(const TAttentionOptions& options,
               const TGazeLimits& limits,
               const landmarks::TTrackingOptions& tracking,
               landmarks::CWideBaselineTracker::Ratio ratio = nullptr);

    /// \param T_o_r Of the robot at the record's time. \param now By a clock that is never set [s].
    void see(const observations::CObservationSalientLandmarks& record,
             const mrpt::poses::CPose2D& T_o_r,
             double now);

    /** Where the head must be turned to now; nothing if it looks there already.
     * \param T_o_r Of the robot now. */
    std::optional<TGaze> gaze(const mrpt::poses::CPose2D& T_o_r,
                              const observations::CObservationPanTilt& head,
                              double now);

    /// An entity is being looked at.
    bool isAttending() const { return m_target.has_value(); }
    std::size_t confirmed() const { return m_confirmed; }
    std::size_t letGo() const { return m_letGo; }  //!< Out of reach, or not confirmed in time.

 private:
    struct TTarget {
        landmarks::TSighting sighting;
        double height{0};  //!< Above the floor [m].
        double since{0};
    };

    bool isDone(const landmarks::TSighting& sighting) const;
    void finish(const landmarks::TSighting& sighting);
    TGaze wanted(const mrpt::poses::CPose2D& T_o_r, const observations::CObservationPanTilt& head);
    bool reaches(const TGaze& gaze) const;

    TAttentionOptions m_options;
    TGazeLimits m_limits;
    landmarks::TTrackingOptions m_tracking;
    landmarks::CWideBaselineTracker m_tracker;
    std::vector<landmarks::TSighting> m_done;  //!< Not to be looked at any more.
    std::optional<TTarget> m_target;
    std::optional<TGaze> m_commanded;
    std::size_t m_confirmed{0}, m_letGo{0};
};

}  // namespace salma::sensing
