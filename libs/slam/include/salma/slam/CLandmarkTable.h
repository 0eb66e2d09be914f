// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/TAssociationProblem.h>
#include <salma/slam/TRunRecord.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <vector>

namespace salma::slam {

/// Log likelihood ratio same/other of a seen patch and a stored one; NaN: cannot tell.
using PatchRatio =
    std::function<double(const observations::TPatch& seen, const observations::TPatch& stored)>;

/// One view of a salient landmark.
struct TView {
    std::shared_ptr<const observations::TPatch> patch;
    double angle{0};  //!< From the wall's normal to the robot, counter-clockwise [rad].
};

/// From the wall's normal to the robot, counter-clockwise, as a measurement states it; without a
/// wall its patch's incidence [rad].
double viewingAngle(const association::TMeasurement& measurement);

/// What is known of a landmark besides its place in the filter.
struct TLandmark {
    int id{0};
    association::ELandmarkKind kind{association::ELandmarkKind::corner};
    bool convex{false};
    std::optional<int> identity;  //!< As the log states it.
    double wallAngle{0};          //!< Of the wall's normal, world; NaN if unknown [rad].
    double wallAngleSigma{0};     //!< [rad]
    /// False: seen from one place only; it helps to find the way, but may be nothing that stays.
    bool confirmed{true};
    std::vector<TView> views;
    double firstWallAngle{0};  //!< As it was at creation, for the record [rad].
    mrpt::math::TPoint2D firstMean;
    Eigen::Matrix2d firstCovariance{Eigen::Matrix2d::Zero()};
    std::size_t sightings{0};
    double firstTime{0}, lastTime{0};  //!< [s since 1970]
    /// Viewing angle at which the appearance last counted for a pairing; none before the first.
    std::optional<double> countedAngle;
    std::set<int> lookAlikes;  //!< Ids of other landmarks of the map that look like this one.
};

/// Heading of the robot when it sees something.
struct THeading {
    double mean{0};   //!< [rad]
    double sigma{0};  //!< [rad]
};

/** Landmarks in the order of the filter's state, with their appearance.
 *
 * A salient landmark keeps up to `maxPatches` views that differ by `patchSpread` in angle; when
 * there are more, the most oblique one goes. */
class CLandmarkTable {
 public:
    CLandmarkTable(int maxPatches, double patchSpread);

    std::size_t size() const { return m_landmarks.size(); }
    const TLandmark& operator[](std::size_t index) const { return m_landmarks[index]; }
    /// \throw std::invalid_argument if no landmark has this id.
    std::size_t indexOf(int id) const;

    /** Appends a landmark, without a sighting yet. \return Its id: the identity of the measurement
     * if it has one that no landmark uses, else the smallest number above all ids. */
    int add(const association::TMeasurement& measurement, double time);

    void setFirst(std::size_t index,
                  const Eigen::Vector2d& mean,
                  const Eigen::Matrix2d& covariance);

    /// The others forget that they looked like it.
    void erase(std::size_t index);

    /// Landmark `gone` turns out to be `kept`, which takes over its views and sightings and keeps
    /// its id; `gone` is erased.
    void merge(std::size_t kept, std::size_t gone);

    /// The world turned under a landmark by an angle [rad].
    void turn(std::size_t index, double angle);

    /// Puts back what another table held. \param nextId Above all ids.
    void restore(std::vector<TLandmark> landmarks, int nextId);
    int nextId() const { return m_nextId; }

    /// Counts a sighting and learns view, wall angle and identity from it. \return True if the view
    /// is kept.
    bool sight(std::size_t index,
               const association::TMeasurement& measurement,
               double time,
               const THeading& heading);

    /// What a robot with that heading expects to see, without range and bearing.
    association::TPredictedLandmark expected(std::size_t index, const THeading& heading) const;

    /// Largest ratio over the views of a landmark; NaN if none can tell.
    double bestRatio(std::size_t index,
                     const observations::TPatch& seen,
                     const PatchRatio& ratio) const;

    /// Notes which other landmarks look like the newest view of this one (ratio above 1), each
    /// judged by its view from the nearest angle. Both sides learn of it.
    void findLookAlikes(std::size_t index, const PatchRatio& ratio);

    /// Share of the salient landmarks of the map that look like this one, [0, 1).
    double lookAlikeShare(std::size_t index) const;

    /// True if one is known by its appearance.
    bool hasPoster() const {
        return std::any_of(m_landmarks.begin(), m_landmarks.end(),
                           [](const TLandmark& l) { return l.confirmed && !l.views.empty(); });
    }

    void setConfirmed(std::size_t index, bool confirmed) {
        m_landmarks[index].confirmed = confirmed;
    }
    void setCounted(std::size_t index, double angle) { m_landmarks[index].countedAngle = angle; }

 private:
    bool addView(TLandmark& landmark, const TView& view);

    std::size_t m_maxPatches;
    double m_patchSpread;
    int m_nextId{0};
    std::vector<TLandmark> m_landmarks;
};

}  // namespace salma::slam
