// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>
#include <salma/observations/TPatch.h>

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

namespace salma::landmarks {

/// Section [tracking] of config.ini: when an entity becomes a landmark.
struct TTrackingOptions : public config::TStrictOptions<TTrackingOptions> {
    int minViews{2};              //!< Places from which it must be seen.
    double minSpread{M_PI / 36};  //!< The directions of these views span so much [rad].
    double minTravel{0.1};        //!< Views less apart are from one place [m].
    double along{0.6};            //!< Sightings of one entity lie so near along its wall [m].
    double across{0.25};          //!< And across it; for things without a wall, all around [m].
    double wallAngle{M_PI / 9};   //!< Its wall is seen under the same angle within this [rad].
    double acceptLogLr{0};        //!< Log likelihood ratio from which two patches look alike.
    int memory{40};               //!< Steps with entities after which one is forgotten.

    void visit(config::COptionVisitor& v);
};

/// A sighting that the association paired with no landmark, in a frame that drifts slowly.
struct TSighting {
    Eigen::Vector2d position{0, 0};  //!< [m]
    Eigen::Vector2d robot{0, 0};     //!< From where it was seen [m].
    /// Direction of its wall's normal towards the robot [rad]; NaN for what hangs on none.
    double wallAngle{std::numeric_limits<double>::quiet_NaN()};
    bool convex{false};                                 //!< Of a corner: only equal ones are one.
    std::shared_ptr<const observations::TPatch> patch;  //!< Null: without appearance.
};

/// True if both may show one thing: the same wall and place along it, or for things without a wall
/// the same place.
bool isSamePlace(const TSighting& a, const TSighting& b, const TTrackingOptions& options);

/** Entities that wait to be seen from elsewhere before the map takes them.
 *
 * What is seen once may be a reflection, a passer-by or a wrong border. A sighting continues the
 * nearest provisional entity whose wall, place along it and appearance agree; once `min_views`
 * places have seen one under angles that span `min_spread`, it is confirmed and forgotten here. It
 * never touches a filter. Corners of the laser wait in the same way, without wall and appearance.
 * Source: K.-L. Ho, transfer report, Oxford 2004, section 4.1.2 (the check); own. */
class CWideBaselineTracker {
 public:
    /// Log likelihood ratio same/other of two patches; NaN: cannot tell. May be null.
    using Ratio = std::function<double(const observations::TPatch&, const observations::TPatch&)>;

    /// \throw std::invalid_argument if options are out of range.
    explicit CWideBaselineTracker(const TTrackingOptions& options = {}, Ratio ratio = nullptr);

    /// Call once per step with entities, before confirms().
    void beginStep();

    /** A step continues an entity at most once.
     * \return True if that was the last view that it needed. Sightings that are not finite confirm
     * nothing and are not kept. */
    bool confirms(const TSighting& sighting);

    /// The frame of the sightings turned out to lie elsewhere: moves all by (x, y, turn) [m, rad].
    void move(const Eigen::Vector3d& motion);

    /// Entities that wait.
    std::size_t size() const { return m_entities.size(); }

 private:
    struct TEntity {
        std::vector<TSighting> views;  //!< The first from each place.
        TSighting last;
        int lastStep{0};
    };
    bool lookAlike(const TSighting& sighting, const TEntity& entity) const;
    void add(const TSighting& sighting, TEntity& entity) const;
    bool isConfirmed(const TEntity& entity) const;

    TTrackingOptions m_options;
    Ratio m_ratio;
    int m_step{0};
    std::vector<TEntity> m_entities;
};

}  // namespace salma::landmarks
