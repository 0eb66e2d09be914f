// SPDX-License-Identifier: BSD-3-Clause
// What posters, corners and odometry say of an alignment.
#include <mrpt/math/wrap2pi.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "CLocalMapSearch.h"
#include "planeMotion.h"

namespace salma::slam {

using association::ELandmarkKind;

namespace {

constexpr double farthestPoster = 10, farthestCorner = 5;  // that are looked for [m]
constexpr int glancesAtCorner = 3;                         // scans that should have shown a corner
/* Corners of one wall stand and fall together, so each counts half: of log(0.75 * 16 / 1 m^2),
 * found within 0.1 m where one is found per square metre, and of log 0.25, not found. */
constexpr double cornerFound = 1.2, cornerMissed = -0.7;
constexpr double thereSeenOnce = 0.6, thereSeenAgain = 0.95;  // a landmark stands for a poster
constexpr double elsewhereToo = 0.5;  // share of a building's posters whose place has one elsewhere
constexpr double contradiction = 0.6;  // two posters nearer than this hang in one place [m]
constexpr double oneMotion = 0.6, oneTurn = 10 * M_PI / 180;  // at the robot [m], [rad]
constexpr std::size_t alignmentsJudged = 16;
constexpr double leastArea = 100;  // in which a lost robot may be [m^2]

Eigen::Index rowOf(std::size_t landmark) { return 3 + 2 * static_cast<Eigen::Index>(landmark); }

/// In the frame of a pose.
Eigen::Vector2d seenFrom(const Eigen::Vector3d& pose, const Eigen::Vector2d& point) {
    return Eigen::Rotation2Dd(-pose[2]) * (point - pose.head<2>());
}

}  // namespace

/** Log probability that the pictures of some steps, which would have shown a poster, did not.
 *
 * \param T Brings the poster into the frame of the steps. */
double CLocalMapSearch::missed(const TMark& mark,
                               const Eigen::Vector3d& T,
                               const TSteps& steps) const {
    const Eigen::Vector2d place = applied(T, mark.place);
    const double wall = m_input.landmarks[mark.index].wallAngle + T[2];
    double logMissed = 0;
    for (std::size_t k = steps.from; k < steps.to; ++k) {
        const TPastStep& step = m_input.history[k];
        if (!step.camera || (step.pose.head<2>() - place).norm() > farthestPoster) continue;
        TBelievedPlace seen;
        seen.point = seenFrom(step.pose, place);
        seen.wallAngle = wall - step.pose[2];
        logMissed += std::log1p(-m_detection.poster(step, seen).probability());
    }
    const double real =
        m_input.landmarks[mark.index].sightings > 1 ? thereSeenAgain : thereSeenOnce;
    const double found = real * std::min(1 - std::exp(logMissed), 1 - m_options.overlooked);
    // In another place that is built alike something hangs there, too, and is missed as often.
    return std::log((1 - found) / (1 - found * (1 - elsewhereToo)));
}

void CLocalMapSearch::weighPosters(TAlignment& alignment) {
    std::set<std::size_t> matchedMarks;
    alignment.posters = alignment.signs = 0;
    for (const TSameLandmark& pair : alignment.pairs) {
        matchedMarks.insert(pair.local);
        matchedMarks.insert(pair.left);
        if (!std::isnan(pair.logRatio))
            (pair.repeats ? alignment.signs : alignment.posters) += pair.logRatio;
    }
    const Eigen::Vector3d& T = alignment.T;
    const Eigen::Vector3d back = inverseOf(T);
    std::set<std::size_t> contradicted;
    for (const TMark& local : m_local) {
        if (!salient(local) || matchedMarks.count(local.index) != 0) continue;
        double other = 0;
        for (const TMark& left : m_left) {
            if (!salient(left) || !isOf(alignment, left) || matchedMarks.count(left.index) != 0 ||
                (left.place - applied(T, local.place)).norm() > contradiction ||
                !mayBeOne(local, left, T[2]))
                continue;
            other = std::min(other, ratio(local, left));
            contradicted.insert(left.index);
        }
        if (other < 0) {
            alignment.posters += other;
        } else if (!m_prints.repeats({local.index, local.place}, back)) {
            const double x = missed(local, T, leftSteps(alignment));
            alignment.posters += x;
        }
    }
    for (const TMark& left : m_left) {
        if (!salient(left) || !isOf(alignment, left) || matchedMarks.count(left.index) != 0 ||
            contradicted.count(left.index) != 0)
            continue;
        if (!m_prints.repeats({left.index, left.place}, T)) {
            const double x = missed(left, back, localSteps());
            alignment.posters += x;
        }
    }
}

/// Steps of the pass that the local map is laid onto.
CLocalMapSearch::TSteps CLocalMapSearch::leftSteps(const TAlignment& alignment) const {
    TSteps result{m_localStart, m_localStart};
    for (std::size_t k = m_localStart; k-- > 0;) {
        if (travelOf(k) > alignment.leftTo) result.to = k;
        if (travelOf(k) >= alignment.leftFrom) result.from = k;
    }
    return result;
}

bool CLocalMapSearch::cornerWasLookedAt(const Eigen::Vector2d& place, const TSteps& steps) const {
    int glances = 0;
    for (const std::size_t k : m_glances) {
        if (k < steps.from || k >= steps.to) continue;
        const TPastStep& step = m_input.history[k];
        const double reach = step.laser ? farthestCorner : 0.8 * m_input.maxRange;
        if ((step.pose.head<2>() - place).norm() > reach) continue;
        const Eigen::Vector2d point = seenFrom(step.pose, place);
        if (step.laser) {
            TBelievedPlace seen;
            seen.point = point;
            if (!CDetectionModel::showsCornerForSure(step, seen)) continue;
        } else if (std::abs(std::atan2(point.y(), point.x())) > 0.9 * m_input.halfField) {
            continue;
        }
        if (++glances >= glancesAtCorner) return true;
    }
    return false;
}

void CLocalMapSearch::weighCorners(TAlignment& alignment) const {
    std::set<std::size_t> matchedMarks;
    alignment.corners = 0;
    for (const TSameLandmark& pair : alignment.pairs) {
        matchedMarks.insert(pair.local);
        matchedMarks.insert(pair.left);
        if (m_input.landmarks[pair.local].kind == ELandmarkKind::corner)
            alignment.corners += cornerFound;
    }
    const Eigen::Vector3d back = inverseOf(alignment.T);
    for (const TMark& local : m_local)
        if (!salient(local) && matchedMarks.count(local.index) == 0 &&
            cornerWasLookedAt(applied(alignment.T, local.place), leftSteps(alignment)))
            alignment.corners += cornerMissed;
    for (const TMark& left : m_left)
        if (!salient(left) && isOf(alignment, left) && matchedMarks.count(left.index) == 0 &&
            cornerWasLookedAt(applied(back, left.place), localSteps()))
            alignment.corners += cornerMissed;
}

/* The shift at the middle of the pairs and the turn, under the covariance between the maps, which
 * is that of the path between them. A turn by some 20 deg bends a long path more than derivatives
 * tell, so half of its square counts too. */
void CLocalMapSearch::weighOdometry(TAlignment& alignment) const {
    const auto& pairs = alignment.pairs;
    const auto n = static_cast<Eigen::Index>(pairs.size());
    Eigen::Vector2d middle(0, 0);
    for (const TSameLandmark& pair : pairs)
        middle += m_input.mean.segment<2>(rowOf(pair.local)) / static_cast<double>(n);
    Eigen::MatrixXd B(2 * n, 3);
    for (Eigen::Index i = 0; i < n; ++i) {
        const Eigen::Vector2d arm = m_input.mean.segment<2>(rowOf(pairs[i].local)) - middle;
        B.middleRows<2>(2 * i) << 1, 0, -arm.y(), 0, 1, arm.x();
    }
    const Eigen::MatrixXd fit = (B.transpose() * B).ldlt().solve(B.transpose());
    Eigen::Matrix3d spread = fit * covarianceOf(pairs, 0) * fit.transpose();
    double lever = 0, area = 0;
    Eigen::Vector2d low = middle, high = middle;
    for (std::size_t k = 0; k < m_input.history.size(); ++k) {
        const Eigen::Vector2d place = m_input.history[k].pose.head<2>();
        lever = std::max(lever, (place - middle).norm());
        low = low.cwiseMin(place);
        high = high.cwiseMax(place);
    }
    area = std::max(leastArea, (high - low).prod());
    spread *= m_options.driftFactor * m_options.driftFactor;
    const double bent = 0.5 * lever * spread(2, 2);
    spread.topLeftCorner<2, 2>() += bent * bent * Eigen::Matrix2d::Identity();
    Eigen::Vector3d shift;
    shift << applied(alignment.T, middle) - middle, alignment.T[2];
    const Eigen::LLT<Eigen::Matrix3d> factor(spread);
    double density = 0;
    if (factor.info() == Eigen::Success) {
        const double distance2 = factor.matrixL().solve(shift).squaredNorm();
        const double determinant = factor.matrixLLT().diagonal().prod();
        density = std::exp(-0.5 * distance2) / (std::pow(2 * M_PI, 1.5) * determinant);
    }
    const double anywhere = 1 / (2 * M_PI * area);
    alignment.odometry = std::log(
        ((1 - m_options.driftOutlier) * density + m_options.driftOutlier * anywhere) / anywhere);
}

bool CLocalMapSearch::sameMotion(const TAlignment& a, const TAlignment& b) const {
    const Eigen::Vector2d here = m_input.mean.head<2>();
    return (applied(a.T, here) - applied(b.T, here)).norm() < oneMotion &&
           std::abs(mrpt::math::wrapToPi(a.T[2] - b.T[2])) < oneTurn;
}

bool CLocalMapSearch::samePass(const TAlignment& a, const TAlignment& b) {
    return a.leftFrom <= b.leftTo && b.leftFrom <= a.leftTo;
}

TAlignment CLocalMapSearch::asTheyLie(const TAlignment& before) {
    findLookAlikes();
    TAlignment all = before;
    all.T.setZero();
    all.pairs = matched(all.T, m_options.pairRadius);
    const auto shared = [&before](const TAlignment& pass) {
        return std::count_if(pass.pairs.begin(), pass.pairs.end(), [&before](const auto& pair) {
            return std::any_of(before.pairs.begin(), before.pairs.end(), [&pair](const auto& own) {
                return own.local == pair.local && own.left == pair.left;
            });
        });
    };
    const auto candidates = passes(all);
    if (candidates.empty()) return before;
    TAlignment result = *std::max_element(
        candidates.begin(), candidates.end(),
        [&](const TAlignment& a, const TAlignment& b) { return shared(a) < shared(b); });
    weighPosters(result);
    weighCorners(result);
    result.T = before.T;
    return result;
}

TRelocation CLocalMapSearch::run() {
    TRelocation result;
    if (m_local.size() < 2 || m_left.size() < 2) return result;
    findLookAlikes();
    std::vector<TAlignment> alignments;
    for (const Eigen::Vector3d& T : proposals())
        for (TAlignment& alignment : aligned(T))
            if (std::none_of(alignments.begin(), alignments.end(), [&](const TAlignment& other) {
                    return sameMotion(alignment, other) && samePass(alignment, other) &&
                           other.pairs.size() >= alignment.pairs.size();
                }))
                alignments.push_back(std::move(alignment));
    const auto promise = [](const TAlignment& a) {
        double sum = 0;
        for (const TSameLandmark& pair : a.pairs)
            sum += std::isnan(pair.logRatio) ? cornerFound : 2 * pair.logRatio;
        return sum;
    };
    std::stable_sort(
        alignments.begin(), alignments.end(),
        [&](const TAlignment& a, const TAlignment& b) { return promise(a) > promise(b); });
    if (alignments.size() > alignmentsJudged) alignments.resize(alignmentsJudged);
    std::vector<TAlignment> sound;
    for (TAlignment& alignment : alignments) {
        if (!dropIncompatible(alignment)) continue;
        weighPosters(alignment);
        weighCorners(alignment);
        weighOdometry(alignment);
        sound.push_back(std::move(alignment));
    }
    std::stable_sort(sound.begin(), sound.end(), [](const TAlignment& a, const TAlignment& b) {
        return a.total() > b.total();
    });
    if (sound.empty()) return result;
    // In another pass the same motion is no rival: the robot may have been here twice.
    result.best = sound.front();
    result.margin = std::numeric_limits<double>::infinity();
    for (const TAlignment& other : sound)
        if (!sameMotion(other, result.best))
            result.margin = std::min(result.margin, result.best.total() - other.total());
    return result;
}

}  // namespace salma::slam
