// SPDX-License-Identifier: BSD-3-Clause
#include "CLocalMapSearch.h"

#include <mrpt/math/wrap2pi.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <boost/math/distributions/chi_squared.hpp>
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
constexpr double slack = 0.03;        // corners are not points, sides of posters not sharp [m]
constexpr double elsewhereFrom = 1;   // two landmarks nearer than this may be one seen twice [m]
constexpr double priorOfTwins = 0.1;  // odds that two posters of a building are prints of one
constexpr double leastOdds = 0.02;    // less is not looked at

double gateOf(std::size_t degreesOfFreedom) {
    return boost::math::quantile(boost::math::chi_squared(static_cast<double>(degreesOfFreedom)),
                                 0.99);
}

double angleBetween(double a, double b) { return std::abs(mrpt::math::wrapToPi(a - b)); }

Eigen::Index rowOf(std::size_t landmark) { return 3 + 2 * static_cast<Eigen::Index>(landmark); }

}  // namespace

CLocalMapSearch::CLocalMapSearch(const TRelocationOptions& options,
                                 const CDetectionModel& detection,
                                 const TRelocationInput& input,
                                 TRatioCache& ratios)
    : m_options(options), m_detection(detection), m_input(input), m_ratios(ratios) {
    split();
    double last = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < input.history.size(); ++k) {
        if (!input.history[k].scanned || input.history[k].travel < last + 0.4) continue;
        m_glances.push_back(k);
        last = input.history[k].travel;
    }
}

/// Into the local map and the one left behind; what lies between belongs to neither.
void CLocalMapSearch::split() {
    const CPathHistory& history = m_input.history;
    std::map<int, std::pair<std::size_t, std::size_t>> steps;
    for (std::size_t k = 0; k < history.size(); ++k)
        for (const auto& used : history[k].used) {
            const auto [entry, isNew] = steps.insert({used.landmark, {k, k}});
            if (!isNew) entry->second.second = k;
        }
    const double now = history.back().travel;
    TMarks others;
    m_localStart = history.size();
    for (std::size_t i = 0; i < m_input.landmarks.size(); ++i) {
        const auto found = steps.find(m_input.landmarks[i].id);
        if (found == steps.end()) continue;
        const TMark mark{i, m_input.mean.segment<2>(rowOf(i)), found->second.first,
                         found->second.second};
        if (history[mark.firstStep].travel < now - m_options.localTravel) {
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

/// Fills `m_alike`.
void CLocalMapSearch::findLookAlikes() {
    const auto consider = [this](const TMark& a, const TMark& b, bool across) {
        const double odds = priorOfTwins * std::exp(ratio(a, b));
        if (!(odds > leastOdds)) return;  // false for NaN
        m_alike[a.index].push_back({b.place, across, odds});
        m_alike[b.index].push_back({a.place, across, odds});
    };
    for (const TMarks* marks : {&m_local, &m_left})
        for (std::size_t i = 0; i < marks->size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (salient((*marks)[i]) && salient((*marks)[j]))
                    consider((*marks)[i], (*marks)[j], false);
    for (const TMark& a : m_local)
        for (const TMark& b : m_left)
            if (salient(a) && salient(b)) consider(a, b, true);
}

/** Whether the building probably has more things that look like a poster.
 *
 * Signs hang where the building's plan puts them: that they fall together says of two places no
 * more than that they are built alike, as corners do.
 * \param T Brings what the other map has into the frame of the mark's own. */
bool CLocalMapSearch::repeats(const TMark& mark, const Eigen::Vector3d& T) const {
    const auto others = m_alike.find(mark.index);
    if (others == m_alike.end()) return false;
    double single = 1;
    for (const TAlike& other : others->second) {
        const Eigen::Vector2d place = other.across ? applied(T, other.place) : other.place;
        if ((place - mark.place).norm() > elsewhereFrom) single /= 1 + other.odds;
    }
    return single < 0.5;
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

/// Nearest first, each landmark once.
std::vector<TSameLandmark> CLocalMapSearch::matched(const Eigen::Vector3d& T, double radius) {
    struct TOption {
        double distance;
        std::size_t local, left;
    };
    std::vector<TOption> options;
    for (std::size_t i = 0; i < m_local.size(); ++i) {
        const Eigen::Vector2d place = applied(T, m_local[i].place);
        for (std::size_t j = 0; j < m_left.size(); ++j) {
            const double distance = (m_left[j].place - place).norm();
            if (!(distance <= radius) || !mayBeOne(m_local[i], m_left[j], T[2])) continue;
            if (salient(m_local[i]) && !(ratio(m_local[i], m_left[j]) > -1)) continue;
            options.push_back({distance, i, j});
        }
    }
    std::stable_sort(options.begin(), options.end(),
                     [](const TOption& a, const TOption& b) { return a.distance < b.distance; });
    std::vector<bool> localTaken(m_local.size(), false), leftTaken(m_left.size(), false);
    std::vector<TSameLandmark> pairs;
    for (const TOption& option : options) {
        if (localTaken[option.local] || leftTaken[option.left]) continue;
        localTaken[option.local] = leftTaken[option.left] = true;
        const TMark &a = m_local[option.local], &b = m_left[option.left];
        TSameLandmark pair{a.index, b.index, option.distance,
                           std::numeric_limits<double>::quiet_NaN()};
        if (salient(a)) {
            pair.logRatio = ratioAmongLookAlikes(a, b);
            pair.repeats = repeats(a, inverseOf(T)) || repeats(b, T);
        }
        pairs.push_back(pair);
    }
    return pairs;
}

TAlignment CLocalMapSearch::aligned(Eigen::Vector3d T) {
    TAlignment result;
    for (const double widening : {2.0, 1.5, 1.0, 1.0}) {
        result.pairs = matched(T, widening * m_options.pairRadius);
        if (result.pairs.size() < 2) break;
        std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> places;
        for (const TSameLandmark& pair : result.pairs)
            places.emplace_back(m_input.mean.segment<2>(rowOf(pair.local)),
                                m_input.mean.segment<2>(rowOf(pair.left)));
        const Eigen::Vector3d better = fitted(places);
        // Two landmarks side by side do not tell the direction: the proposal stays.
        if (angleBetween(better[2], T[2]) > 15 * M_PI / 180) break;
        T = better;
    }
    result.T = T;
    return result;
}

Eigen::MatrixXd CLocalMapSearch::covarianceOf(const std::vector<TSameLandmark>& pairs,
                                              double turn) const {
    const Eigen::Matrix2d R = Eigen::Rotation2Dd(turn).toRotationMatrix();
    const RowMatrix& P = m_input.covariance;
    const auto n = static_cast<Eigen::Index>(pairs.size());
    Eigen::MatrixXd result = slack * slack * Eigen::MatrixXd::Identity(2 * n, 2 * n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j) {
            const Eigen::Index a = rowOf(pairs[i].local), b = rowOf(pairs[i].left);
            const Eigen::Index c = rowOf(pairs[j].local), d = rowOf(pairs[j].left);
            result.block<2, 2>(2 * i, 2 * j) += R * P.block<2, 2>(a, c) * R.transpose() +
                                                P.block<2, 2>(b, d) - R * P.block<2, 2>(a, d) -
                                                P.block<2, 2>(b, c) * R.transpose();
        }
    return result;
}

/* Joint compatibility of both maps, T free: generalised least squares over all pairs. The worst
 * pair goes until the rest agrees. False if too much would have to go. */
bool CLocalMapSearch::dropIncompatible(TAlignment& alignment) const {
    const std::size_t before = alignment.pairs.size();
    while (alignment.pairs.size() >= 2 && 3 * alignment.pairs.size() >= 2 * before) {
        const auto& pairs = alignment.pairs;
        const auto n = static_cast<Eigen::Index>(pairs.size());
        Eigen::VectorXd r(2 * n);
        Eigen::MatrixXd B(2 * n, 3);
        for (Eigen::Index i = 0; i < n; ++i) {
            const Eigen::Vector2d p =
                applied(alignment.T, m_input.mean.segment<2>(rowOf(pairs[i].local)));
            const Eigen::Vector2d arm = p - alignment.T.head<2>();
            r.segment<2>(2 * i) = p - m_input.mean.segment<2>(rowOf(pairs[i].left));
            B.middleRows<2>(2 * i) << 1, 0, -arm.y(), 0, 1, arm.x();
        }
        const Eigen::LLT<Eigen::MatrixXd> factor(covarianceOf(pairs, alignment.T[2]));
        if (factor.info() != Eigen::Success) return false;
        const Eigen::MatrixXd X = factor.solve(B);
        const Eigen::Vector3d shift = -(B.transpose() * X).ldlt().solve(X.transpose() * r);
        const Eigen::VectorXd left = r + B * shift;
        const Eigen::VectorXd weighed = factor.solve(left);
        alignment.distance2 = left.dot(weighed);
        if (!std::isfinite(alignment.distance2)) return false;
        if (alignment.distance2 <= gateOf(2 * pairs.size() - 3)) {
            for (Eigen::Index i = 0; i < n; ++i)
                alignment.pairs[i].distance = left.segment<2>(2 * i).norm();
            alignment.T += shift;
            alignment.T[2] = mrpt::math::wrapToPi(alignment.T[2]);
            return true;
        }
        Eigen::Index worst = 0;
        double share = -std::numeric_limits<double>::infinity();
        for (Eigen::Index i = 0; i < n; ++i) {
            const double own = left.segment<2>(2 * i).dot(weighed.segment<2>(2 * i));
            if (own > share) {
                share = own;
                worst = i;
            }
        }
        alignment.pairs.erase(alignment.pairs.begin() + worst);
    }
    return false;
}

}  // namespace salma::slam
