// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/landmarks/CWideBaselineTracker.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

namespace salma::landmarks {
namespace {

/// From the wall's normal to the robot [rad]; 0 for what hangs on no wall.
double viewAngle(const TSighting& s) {
    if (std::isnan(s.wallAngle)) return 0;
    const Eigen::Vector2d ray = s.robot - s.position;
    return mrpt::math::wrapToPi(std::atan2(ray.y(), ray.x()) - s.wallAngle);
}

}  // namespace

bool isSamePlace(const TSighting& a, const TSighting& b, const TTrackingOptions& options) {
    if (a.convex != b.convex || std::isnan(a.wallAngle) != std::isnan(b.wallAngle)) return false;
    const Eigen::Vector2d apart = a.position - b.position;
    if (std::isnan(b.wallAngle)) return apart.norm() <= options.across;
    const double turn = mrpt::math::wrapToPi(a.wallAngle - b.wallAngle);
    const Eigen::Vector2d normal(std::cos(b.wallAngle), std::sin(b.wallAngle));
    const double across = std::abs(normal.dot(apart));
    const double along = std::abs(normal.x() * apart.y() - normal.y() * apart.x());
    return std::abs(turn) <= options.wallAngle && across <= options.across &&
           along <= options.along;
}

void TTrackingOptions::visit(config::COptionVisitor& v) {
    v.integer("min_views", minViews, config::between(1, 100),
              "places from which an entity must be seen before it becomes a landmark");
    v.degrees("min_spread_deg", minSpread, config::between(0, 120),
              "angle that the directions of these views span, at least");
    v.number("min_travel_m", minTravel, config::atLeast(0), "views less apart are from one place");
    v.number("along_m", along, config::moreThan(0),
             "sightings of one entity lie this near to each other along its wall");
    v.number("across_m", across, config::moreThan(0), "and across it");
    v.degrees("wall_angle_deg", wallAngle, config::insideOf(0, 180),
              "the walls of two sightings of one entity differ by less");
    v.number("accept_log_lr", acceptLogLr, config::anyNumber(),
             "log likelihood ratio from which two sightings look alike");
    v.integer("memory_steps", memory, config::atLeast(1),
              "steps with entities after which one that is not seen is forgotten");
}

CWideBaselineTracker::CWideBaselineTracker(const TTrackingOptions& options, Ratio ratio)
    : m_options(options), m_ratio(std::move(ratio)) {
    m_options.validate();
}

void CWideBaselineTracker::beginStep() {
    ++m_step;
    const auto forgotten = [this](const TEntity& e) {
        return m_step - e.lastStep > m_options.memory;
    };
    m_entities.erase(std::remove_if(m_entities.begin(), m_entities.end(), forgotten),
                     m_entities.end());
}

void CWideBaselineTracker::move(const Eigen::Vector3d& motion) {
    const Eigen::Rotation2Dd turn(motion[2]);
    const auto moveOne = [&](TSighting& sighting) {
        sighting.position = motion.head<2>() + turn * sighting.position;
        sighting.robot = motion.head<2>() + turn * sighting.robot;
        if (!std::isnan(sighting.wallAngle))
            sighting.wallAngle = mrpt::math::wrapToPi(sighting.wallAngle + motion[2]);
    };
    for (TEntity& entity : m_entities) {
        moveOne(entity.last);
        for (TSighting& view : entity.views) moveOne(view);
    }
}

bool CWideBaselineTracker::confirms(const TSighting& sighting) {
    if (!sighting.position.allFinite() || !sighting.robot.allFinite()) return false;
    TEntity* nearest = nullptr;
    double distance = std::numeric_limits<double>::infinity();
    for (auto& entity : m_entities) {
        if (entity.lastStep == m_step || !isSamePlace(sighting, entity.last, m_options)) continue;
        const double apart = (entity.last.position - sighting.position).norm();
        if (!(apart < distance) || !lookAlike(sighting, entity)) continue;
        distance = apart;
        nearest = &entity;
    }
    if (nearest == nullptr) nearest = &m_entities.emplace_back();
    add(sighting, *nearest);
    if (!isConfirmed(*nearest)) return false;
    m_entities.erase(m_entities.begin() + (nearest - m_entities.data()));
    return true;
}

/// With the view from the nearest direction; what has no appearance is not told apart by it.
bool CWideBaselineTracker::lookAlike(const TSighting& sighting, const TEntity& entity) const {
    if (!m_ratio || !sighting.patch) return true;
    const double angle = viewAngle(sighting);
    const TSighting* best = nullptr;
    for (const auto& view : entity.views)
        if (view.patch && (best == nullptr ||
                           std::abs(viewAngle(view) - angle) < std::abs(viewAngle(*best) - angle)))
            best = &view;
    if (best == nullptr) return true;
    return m_ratio(*sighting.patch, *best->patch) >= m_options.acceptLogLr;  // false for NaN
}

void CWideBaselineTracker::add(const TSighting& sighting, TEntity& entity) const {
    entity.lastStep = m_step;
    entity.last = sighting;
    // The first view of a place stays: one that followed the robot would never be far from it.
    const auto fromSamePlace = [&](const TSighting& view) {
        return (view.robot - sighting.robot).norm() < m_options.minTravel;
    };
    if (std::none_of(entity.views.begin(), entity.views.end(), fromSamePlace))
        entity.views.push_back(sighting);
}

bool CWideBaselineTracker::isConfirmed(const TEntity& entity) const {
    if (entity.views.size() < static_cast<std::size_t>(m_options.minViews)) return false;
    double low = viewAngle(entity.last), high = low;
    for (const auto& view : entity.views) {
        const double angle = viewAngle(view);
        low = std::min(low, angle);
        high = std::max(high, angle);
    }
    return high - low >= m_options.minSpread;
}

}  // namespace salma::landmarks
