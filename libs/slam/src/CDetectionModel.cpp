// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/slam/CDetectionModel.h>

#include <algorithm>

namespace salma::slam {

using association::ELandmarkKind;
using association::TAssociationProblem;
using association::TDetectability;

namespace {

/* A poster at the border of the picture is cut: half of those are found whose centre lies so far
 * out, as a share of the half field, give or take the blur. */
constexpr double fieldBorder = 0.925, fieldBlur = 0.05;
constexpr double raySlack = 0.3;  // a beam may end so much before what it should reach [m]
constexpr double posterSpread = 0.2, cornerSpread = 0.1;  // beams that pass nearer count [m]
/* A poster of which half is covered is not found. A corner stands at the end of what covers the
 * half behind it, and seen along a wall the beams beside it end early: half of them are enough. */
constexpr double posterHidden = 0.5, cornerFree = 0.5;  // shares of beams that reach it
constexpr double negligible = 1e-4;

/// Probability that a normally distributed value is below a limit.
double probabilityBelow(double limit, double mean, double sigma) {
    if (!(sigma > 0)) return mean <= limit ? 1 : 0;
    return 0.5 * std::erfc((mean - limit) / (sigma * M_SQRT2));
}

/// Probability that a direction lies within half a field of its middle.
double probabilityInside(double halfField, double offAxis, double sigma) {
    if (!(halfField < M_PI)) return 1;
    return probabilityBelow(halfField, offAxis, sigma) -
           probabilityBelow(-halfField, offAxis, sigma);
}

/// From a sensor to a place.
struct TRay {
    double length{0};                      //!< [m]
    double direction{0};                   //!< Robot frame [rad].
    double sigmaAlong{0}, sigmaAcross{0};  //!< Of the place, to the ray [m].

    TRay(const TBelievedPlace& place, const Eigen::Vector2d& from) {
        const Eigen::Vector2d ray = place.point - from;
        length = std::max(ray.norm(), 1e-3);
        direction = std::atan2(ray.y(), ray.x());
        const Eigen::Vector2d along(std::cos(direction), std::sin(direction));
        const Eigen::Vector2d across(-along.y(), along.x());
        sigmaAlong = std::sqrt(std::max(0.0, along.dot(place.covariance * along)));
        sigmaAcross = std::sqrt(std::max(0.0, across.dot(place.covariance * across)));
    }

    double sigmaDirection() const { return sigmaAcross / length; }
};

/// Between a ray to a place and the normal of its wall; 0 where the wall is not known [rad].
double incidenceOf(const TRay& ray, const TBelievedPlace& place) {
    if (std::isnan(place.wallAngle)) return 0;
    return std::abs(mrpt::math::wrapToPi(ray.direction + M_PI - place.wallAngle));
}

/// Share of the laser's beams towards a place that do not end before it.
double reaching(const TViews& views, const TBelievedPlace& place, double spread) {
    if (!views.laser) return 1;
    const TRay ray(place, views.laser->sensor.head<2>());
    return views.laser->reaching(place.point, raySlack + 2 * ray.sigmaAlong,
                                 spread + ray.sigmaAcross);
}

TBelievedPlace placeOf(const association::TPredictedLandmark& expected,
                       const Eigen::Matrix2d& covariance) {
    const double c = std::cos(expected.z[1]), s = std::sin(expected.z[1]);
    Eigen::Matrix2d J;  // of (x, y) by (range, bearing)
    J << c, -expected.z[0] * s, s, expected.z[0] * c;
    return {expected.z[0] * Eigen::Vector2d(c, s), J * covariance * J.transpose(),
            expected.wallAngle, expected.wallAngleSigma};
}

/// Of one picture no more are taken: all are scaled so that they sum up to it at most.
void share(std::size_t most, TAssociationProblem& problem) {
    double sum = 0;
    for (const auto& landmark : problem.landmarks)
        if (landmark.kind == ELandmarkKind::salient) sum += landmark.detection->probability();
    const auto isPoster = [](const auto& m) { return m.kind == ELandmarkKind::salient; };
    const auto taken = static_cast<std::size_t>(
        std::count_if(problem.measurements.begin(), problem.measurements.end(), isPoster));
    const auto limit = static_cast<double>(std::max(most, taken));
    if (!(sum > limit)) return;
    for (auto& landmark : problem.landmarks)
        if (landmark.kind == ELandmarkKind::salient) landmark.detection->found *= limit / sum;
}

}  // namespace

CDetectionModel::CDetectionModel(const TDetectionOptions& options, const TUnstatedView& unstated)
    : m_options(options), m_unstated(unstated) {
    m_options.validate();
}

double CDetectionModel::posterInView(const TViews& views, const TBelievedPlace& place) {
    if (!views.camera) return 0;
    const TCameraView& camera = *views.camera;
    const TRay ray(place, camera.camera.head<2>());
    const double seen =
        probabilityInside(fieldBorder * camera.halfField,
                          mrpt::math::wrapToPi(ray.direction - camera.camera[2]),
                          std::hypot(ray.sigmaDirection(), fieldBlur * camera.halfField)) *
        probabilityBelow(M_PI_2, incidenceOf(ray, place), place.wallAngleSigma);
    if (!(seen > negligible)) return 0;
    const double share = reaching(views, place, posterSpread);
    return seen * std::max(0.0, (share - posterHidden) / (1 - posterHidden));
}

double CDetectionModel::cornerInView(const TViews& views, const TBelievedPlace& place) {
    if (!views.scanned || !views.laser || !views.laser->free) return 0;
    const TRay ray(place, views.laser->sensor.head<2>());
    const double seen = probabilityInside(
        views.laser->halfField(),
        mrpt::math::wrapToPi(ray.direction - views.laser->sensor[2] - views.laser->middle()),
        ray.sigmaDirection());
    if (!(seen > negligible)) return 0;
    return seen * std::min(1.0, reaching(views, place, cornerSpread) / cornerFree);
}

bool CDetectionModel::showsCornerForSure(const TViews& views, const TBelievedPlace& place) {
    return views.laser && views.laser->looksAt(place.point) &&
           reaching(views, place, cornerSpread) == 1;
}

TDetectability CDetectionModel::poster(const TViews& views, const TBelievedPlace& place) const {
    const double inView = posterInView(views, place);
    const TRay ray(place, views.camera ? Eigen::Vector2d(views.camera->camera.head<2>())
                                       : Eigen::Vector2d::Zero());
    return {inView, m_options.probability(incidenceOf(ray, place), ray.length)};
}

TDetectability CDetectionModel::corner(const TViews& views, const TBelievedPlace& place) const {
    const double inView = cornerInView(views, place);
    const TRay ray(place, views.laser ? Eigen::Vector2d(views.laser->sensor.head<2>())
                                      : Eigen::Vector2d::Zero());
    return {inView, m_options.cornerProbability(ray.length)};
}

TDetectability CDetectionModel::unstated(const Eigen::Vector2d& z,
                                         const Eigen::Matrix2d& covariance) const {
    return {probabilityBelow(m_unstated.maxRange, z[0], std::sqrt(covariance(0, 0))) *
                probabilityInside(m_unstated.halfField, z[1], std::sqrt(covariance(1, 1))),
            m_unstated.probability};
}

void CDetectionModel::state(const TViews& views, TAssociationProblem& problem) const {
    const bool stated = views.camera || (views.scanned && views.laser);
    for (std::size_t k = 0; k < problem.landmarks.size(); ++k) {
        auto& landmark = problem.landmarks[k];
        const auto row = static_cast<Eigen::Index>(2 * k);
        const Eigen::Matrix2d covariance = problem.predictionCovariance.block<2, 2>(row, row);
        if (!stated)
            landmark.detection = unstated(landmark.z, covariance);
        else if (landmark.kind == ELandmarkKind::salient)
            landmark.detection = poster(views, placeOf(landmark, covariance));
        else
            landmark.detection = corner(views, placeOf(landmark, covariance));
    }
    if (views.camera) share(views.camera->mostPosters, problem);
}

}  // namespace salma::slam
