// SPDX-License-Identifier: BSD-3-Clause
// Which landmarks fall together in an alignment, and whether they can.
#include <mrpt/math/wrap2pi.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>

#include "CLocalMapSearch.h"
#include "planeMotion.h"

namespace salma::slam {

namespace {

constexpr double longestStretch = 15;  // of the way between two pairs of one pass [m]
constexpr double slack = 0.03;         // corners are not points, sides of posters not sharp [m]

double gateOf(std::size_t degreesOfFreedom) {
    return boost::math::quantile(boost::math::chi_squared(static_cast<double>(degreesOfFreedom)),
                                 0.99);
}

double angleBetween(double a, double b) { return std::abs(mrpt::math::wrapToPi(a - b)); }

Eigen::Index rowOf(std::size_t landmark) { return 3 + 2 * static_cast<Eigen::Index>(landmark); }

}  // namespace

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
            pair.repeats = m_prints.repeats({a.index, a.place}, inverseOf(T)) ||
                           m_prints.repeats({b.index, b.place}, T);
        }
        pairs.push_back(pair);
    }
    return pairs;
}

/* A robot that drives along a way which it has driven before meets what it saw then in the same
 * order, or in the opposite one. Where the landmarks that fall together jump to another time, that
 * is another pass, perhaps on another floor: one may be true and the other not. */
std::vector<TAlignment> CLocalMapSearch::passes(const TAlignment& alignment) const {
    struct TMet {
        TSameLandmark pair;
        double local, leftFrom, leftTo;  // travel
        std::size_t pass;
    };
    const auto markOf = [](const TMarks& marks, std::size_t index) {
        return *std::find_if(marks.begin(), marks.end(),
                             [index](const TMark& mark) { return mark.index == index; });
    };
    std::vector<TMet> met;
    for (const TSameLandmark& pair : alignment.pairs) {
        const TMark left = markOf(m_left, pair.left);
        met.push_back({pair, travelOf(markOf(m_local, pair.local).firstStep),
                       travelOf(left.firstStep), travelOf(left.lastStep), met.size()});
    }
    for (std::size_t i = 0; i < met.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const double local = std::abs(met[i].local - met[j].local);
            const double left =
                std::max(met[i].leftFrom, met[j].leftFrom) - std::min(met[i].leftTo, met[j].leftTo);
            if (local > longestStretch || left > local + m_options.gap) continue;
            const std::size_t gone = met[i].pass, kept = met[j].pass;
            for (TMet& other : met)
                if (other.pass == gone) other.pass = kept;
        }
    std::vector<TAlignment> result;
    for (std::size_t pass = 0; pass < met.size(); ++pass) {
        TAlignment one;
        one.T = alignment.T;
        one.odometry = alignment.odometry;
        one.leftFrom = std::numeric_limits<double>::infinity();
        for (const TMet& each : met) {
            if (each.pass != pass) continue;
            one.pairs.push_back(each.pair);
            one.leftFrom = std::min(one.leftFrom, each.leftFrom - m_options.gap);
            one.leftTo = std::max(one.leftTo, each.leftTo + m_options.gap);
        }
        if (one.pairs.size() >= 2) result.push_back(std::move(one));
    }
    return result;
}

bool CLocalMapSearch::isOf(const TAlignment& alignment, const TMark& left) const {
    return travelOf(left.firstStep) <= alignment.leftTo &&
           travelOf(left.lastStep) >= alignment.leftFrom;
}

std::vector<TAlignment> CLocalMapSearch::aligned(Eigen::Vector3d T) {
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
    return passes(result);
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
