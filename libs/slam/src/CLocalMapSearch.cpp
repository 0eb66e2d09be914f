// SPDX-License-Identifier: BSD-3-Clause
#include "CLocalMapSearch.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "planeMotion.h"

namespace salma::slam {

using association::ELandmarkKind;

namespace {

constexpr double wallTolerance = 25 * M_PI / 180;
constexpr double largestTurn = M_PI / 3;                       // of proposals by corners alone
constexpr double cellLength = 0.4, cellTurn = 6 * M_PI / 180;  // in which proposals are one
constexpr std::size_t proposalsJudged = 80, pairsOfCorners = 24;

double angleBetween(double a, double b) { return std::abs(mrpt::math::wrapToPi(a - b)); }

Eigen::Index rowOf(std::size_t landmark) { return 3 + 2 * static_cast<Eigen::Index>(landmark); }

}  // namespace

CLocalMapSearch::CLocalMapSearch(const TRelocationOptions& options,
                                 const CDetectionModel& detection,
                                 const TRelocationInput& input,
                                 double since,
                                 TRatioCache& ratios)
    : m_options(options), m_detection(detection), m_input(input), m_ratios(ratios) {
    split(since);
    double last = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < input.history.size(); ++k) {
        if (!input.history[k].scanned || input.history[k].travel < last + 0.4) continue;
        m_glances.push_back(k);
        last = input.history[k].travel;
    }
}

/// Into the local map and the one left behind; what lies between belongs to neither.
void CLocalMapSearch::split(double since) {
    const CPathHistory& history = m_input.history;
    const auto steps = history.steps();
    TMarks others;
    m_localStart = history.size();
    for (std::size_t i = 0; i < m_input.landmarks.size(); ++i) {
        const auto found = steps.find(m_input.landmarks[i].id);
        if (found == steps.end()) continue;
        const TMark mark{i, m_input.mean.segment<2>(rowOf(i)), found->second.first,
                         found->second.second};
        if (history[mark.firstStep].travel < since) {
            others.push_back(mark);
        } else {
            m_local.push_back(mark);
            m_localStart = std::min(m_localStart, mark.firstStep);
        }
    }
    // With a young local map the landmarks just passed are not what the robot may have come back
    // to.
    const double limit = m_local.empty() ? 0 : history[m_localStart].travel - m_options.gap;
    for (const TMark& mark : others)
        if (history[mark.lastStep].travel <= limit) m_left.push_back(mark);
}

bool CLocalMapSearch::salient(const TMark& mark) const {
    return m_input.landmarks[mark.index].kind == ELandmarkKind::salient;
}

bool CLocalMapSearch::mayBeOne(const TMark& local, const TMark& left, double turn) const {
    const TLandmark& a = m_input.landmarks[local.index];
    const TLandmark& b = m_input.landmarks[left.index];
    if (a.kind != b.kind || (a.kind == ELandmarkKind::corner && a.convex != b.convex)) return false;
    if (a.identity && b.identity && a.identity != b.identity) return false;
    if (std::isnan(a.wallAngle) || std::isnan(b.wallAngle)) return true;
    return angleBetween(a.wallAngle + turn, b.wallAngle) <= wallTolerance;
}

/// Of the two views from the nearest angles: views of one pass say the same, so one pair counts.
double CLocalMapSearch::ratio(const TMark& local, const TMark& left) {
    const TLandmark& a = m_input.landmarks[local.index];
    const TLandmark& b = m_input.landmarks[left.index];
    if (!m_input.ratio || a.views.empty() || b.views.empty())
        return std::numeric_limits<double>::quiet_NaN();
    const std::array<int, 4> key{a.id, static_cast<int>(a.sightings), b.id,
                                 static_cast<int>(b.sightings)};
    const auto [entry, isNew] = m_ratios.insert({key, 0});
    if (!isNew) return entry->second;
    double nearest = std::numeric_limits<double>::infinity();
    const TView *seen = nullptr, *stored = nullptr;
    for (const TView& x : a.views)
        for (const TView& y : b.views)
            if (angleBetween(x.angle, y.angle) < nearest) {
                nearest = angleBetween(x.angle, y.angle);
                seen = &x;
                stored = &y;
            }
    return entry->second = m_input.ratio(*seen->patch, *stored->patch);
}

/// Others that look like it make a landmark say less: p(score|other) is a mixture.
double CLocalMapSearch::ratioAmongLookAlikes(const TMark& local, const TMark& left) {
    const double plain = ratio(local, left);
    if (!(plain > 0)) return plain;
    double alike = 0, all = 0;
    for (const TMark& other : m_left) {
        if (!salient(other) || m_input.landmarks[other.index].views.empty()) continue;
        ++all;
        alike += other.index != left.index && ratio(local, other) > 0;
    }
    const double q = alike / all;
    return -std::log((1 - q) * std::exp(-plain) + q);
}

/// Which posters of both maps may be prints of one picture.
void CLocalMapSearch::findLookAlikes() {
    const auto consider = [this](const TMark& a, const TMark& b, bool across) {
        if (salient(a) && salient(b))
            m_prints.add({a.index, a.place}, {b.index, b.place}, across, ratio(a, b));
    };
    for (const TMarks* marks : {&m_local, &m_left})
        for (std::size_t i = 0; i < marks->size(); ++i)
            for (std::size_t j = 0; j < i; ++j) consider((*marks)[i], (*marks)[j], false);
    for (const TMark& a : m_local)
        for (const TMark& b : m_left) consider(a, b, true);
}

/// Whether odometry lets two landmarks be one, generously.
bool CLocalMapSearch::inReach(const TMark& local, const TMark& left) const {
    const Eigen::Index a = rowOf(local.index), b = rowOf(left.index);
    const RowMatrix& P = m_input.covariance;
    const Eigen::Matrix2d apart =
        P.block<2, 2>(a, a) + P.block<2, 2>(b, b) - P.block<2, 2>(a, b) - P.block<2, 2>(b, a);
    const double largest = std::sqrt(std::max(0.0, apart.trace()));
    return (local.place - left.place).norm() <=
           3 * m_options.driftFactor * largest + m_options.pairRadius;
}

/* Each pair of posters that look alike, and pairs of corners; the most often proposed first. A
 * poster counts for many corners. */
std::vector<Eigen::Vector3d> CLocalMapSearch::proposals() {
    struct TCell {
        Eigen::Vector3d T;
        double votes{0};
    };
    std::map<std::tuple<int, int, int>, TCell> cells;
    const Eigen::Vector2d here = m_input.mean.head<2>();
    const auto propose = [&](const Eigen::Vector3d& T, double votes) {
        const Eigen::Vector2d moved = applied(T, here);
        const auto cell = std::make_tuple(static_cast<int>(std::floor(moved.x() / cellLength)),
                                          static_cast<int>(std::floor(moved.y() / cellLength)),
                                          static_cast<int>(std::floor(T[2] / cellTurn)));
        auto& entry = cells[cell];
        if (entry.votes == 0) entry.T = T;
        entry.votes += votes;
    };
    TMarks corners;
    for (const TMark& mark : m_local) {
        if (!salient(mark)) {
            corners.push_back(mark);
            continue;
        }
        const double wall = m_input.landmarks[mark.index].wallAngle;
        for (const TMark& left : m_left) {
            const double leftWall = m_input.landmarks[left.index].wallAngle;
            if (!salient(left) || std::isnan(wall) || std::isnan(leftWall)) continue;
            if (!(ratio(mark, left) > 0)) continue;
            Eigen::Vector3d T(0, 0, mrpt::math::wrapToPi(leftWall - wall));
            T.head<2>() = left.place - applied(T, mark.place);
            propose(T, 20);
        }
    }
    // The youngest corners lie where the robot is.
    std::stable_sort(corners.begin(), corners.end(),
                     [](const TMark& a, const TMark& b) { return a.lastStep > b.lastStep; });
    std::size_t chosen = 0;
    for (std::size_t j = 1; j < std::min<std::size_t>(corners.size(), 16); ++j)
        for (std::size_t i = 0; i < j && chosen < pairsOfCorners; ++i) {
            const Eigen::Vector2d base = corners[j].place - corners[i].place;
            if (!(base.norm() >= 2 && base.norm() <= 12)) continue;
            ++chosen;
            for (const TMark& a : m_left) {
                if (!mayBeOne(corners[i], a, 0) || !inReach(corners[i], a)) continue;
                for (const TMark& b : m_left) {
                    const Eigen::Vector2d other = b.place - a.place;
                    if (std::abs(other.norm() - base.norm()) > 0.15 ||
                        !mayBeOne(corners[j], b, 0) || !inReach(corners[j], b))
                        continue;
                    const Eigen::Vector3d T =
                        fitted({{corners[i].place, a.place}, {corners[j].place, b.place}});
                    if (std::abs(T[2]) <= largestTurn) propose(T, 1);
                }
            }
        }
    std::vector<TCell> sorted;
    for (const auto& entry : cells) sorted.push_back(entry.second);
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const TCell& a, const TCell& b) { return a.votes > b.votes; });
    std::vector<Eigen::Vector3d> result;
    for (std::size_t k = 0; k < std::min(sorted.size(), proposalsJudged); ++k)
        result.push_back(sorted[k].T);
    return result;
}

}  // namespace salma::slam
