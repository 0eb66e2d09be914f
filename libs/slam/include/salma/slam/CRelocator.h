// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/slam/CDetectionModel.h>
#include <salma/slam/CLandmarkTable.h>
#include <salma/slam/CPathHistory.h>
#include <salma/slam/TRelocationOptions.h>
#include <salma/slam/blockFilter.h>

#include <Eigen/Core>
#include <array>
#include <map>
#include <utility>
#include <vector>

namespace salma::slam {

/// What relocation looks at. All must outlive the call.
struct TRelocationInput {
    const CLandmarkTable& landmarks;
    const Eigen::VectorXd& mean;  //!< Pose and landmarks [3 + 2N].
    const RowMatrix& covariance;  //!< Of `mean`.
    const CPathHistory& history;
    const PatchRatio& ratio;  //!< May be null.
    double maxRange{40};      //!< Of sensors without a stated view [m].
    double halfField{M_PI};   //!< Likewise [rad].
};

/// A landmark of the local map and the one of the left map that it is.
struct TSameLandmark {
    std::size_t local{0}, left{0};  //!< Indices in the table.
    double distance{0};             //!< Between them after alignment [m].
    double logRatio{0};             //!< Of their appearance; NaN for corners.
    bool repeats{false};            //!< Things that look like it hang elsewhere, too.
};

/// A way to lay the local map onto the map that was left behind.
struct TAlignment {
    Eigen::Vector3d T{0, 0, 0};  //!< World as the filter has it to the left map (x, y, turn).
    std::vector<TSameLandmark> pairs;
    /// Stretch of the path, as travel, whose map the local one is laid onto [m].
    double leftFrom{0}, leftTo{0};
    double posters{0};    //!< What posters say, seen and missed [nats].
    double signs{0};      //!< What posters say of which the building has several [nats].
    double corners{0};    //!< What corners say [nats].
    double odometry{0};   //!< What the path says [nats].
    double distance2{0};  //!< Of all pairs together, with T free: 2 n - 3 degrees of freedom.

    double score(double geometryCap) const;
    /// Against other alignments: corners count in full.
    double total() const { return posters + signs + corners + odometry; }
    std::size_t matchedPosters() const;
};

enum class ERelocation {
    nothing,    //!< No local map, no other map, or no alignment at all.
    unproved,   //!< The best alignment explains what was seen no better than a new place.
    ambiguous,  //!< Another alignment is nearly as good.
    found       //!< Worth a closer look.
};

struct TRelocation {
    ERelocation outcome{ERelocation::nothing};
    TAlignment best;
    double margin{0};  //!< Lead over the second-best alignment; infinite without one [nats].
};

/// Log ratios by the ids of two landmarks and the numbers of their sightings, which may add views.
using TRatioCache = std::map<std::array<int, 4>, double>;

/** Finds where the local map lies on the map that was left behind.
 *
 * Local are landmarks first seen during the last `localTravel` metres; left behind those last seen
 * before these by `gap` at least. Alignments are proposed by each pair of posters that look alike
 * (place and wall give the whole pose) and, near to where odometry believes to be, by pairs of
 * corners. Each is judged on the whole local map:
 *  - posters: log LR of those that fall together; for those that do not, the probability that the
 *    other pass, which looked there, overlooked it;
 *  - corners likewise, without appearance; buildings repeat, so against "a new place" they and
 *    posters of which there are several count `geometryCap` at most, but in full between
 *    alignments;
 *  - odometry: log density of the shift that it would have to have made, its covariance widened by
 *    `driftFactor`, mixed with being lost altogether. That a place is near does not prove that it
 *    is the same (there are other floors): against "a new place" it only speaks against.
 * What falls together is parted by the passes in which the left map was made, each an alignment of
 * its own: of two floors that lie on each other one may be meant and the other not. Worth a closer
 * look is an alignment that reaches `propose`, leads by `margin`, and whose pairs are jointly
 * compatible under the covariance of both maps; it is proved if it reaches `accept` with all that
 * was seen since the robot left what it matched. Source: Neira, Tardos and Castellanos, ICRA 2003
 * (geometric constraints); scores own. */
class CRelocator {
 public:
    /// \throw std::invalid_argument if options are out of range.
    explicit CRelocator(const TRelocationOptions& options = {},
                        const TDetectionOptions& detection = {});

    /// The best alignment of the local map; `found` if it reaches `propose` and leads by `margin`.
    TRelocation find(const TRelocationInput& input);

    /** An alignment judged by all that was seen since the robot left the landmarks that it matched.
     *
     * \param laid Both maps laid together as the alignment has it, bent as they may be. */
    TAlignment extended(const TRelocationInput& laid, const TAlignment& alignment);

    /// Whether it reaches `accept`.
    bool proves(const TAlignment& alignment) const;

 private:
    TRelocationOptions m_options;
    CDetectionModel m_detection;
    TRatioCache m_ratios;
};

}  // namespace salma::slam
