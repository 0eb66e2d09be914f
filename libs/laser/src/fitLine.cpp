// SPDX-License-Identifier: BSD-3-Clause
#include "fitLine.h"

#include <Eigen/Dense>
#include <algorithm>

namespace salma::laser {
namespace {

constexpr int kIterations = 4;
constexpr double kRough = 1.5;  // chi-square per degree of freedom that noise alone rarely reaches

/// Brings rho to >= 0.
TFit normalised(double rho, double c, double s) {
    TFit fit;
    const double sign = rho < 0 ? -1 : 1;
    const double norm = std::hypot(c, s);
    fit.rho = sign * rho;
    fit.cosine = sign * c / norm;
    fit.sine = sign * s / norm;
    return fit;
}

struct TNormalEquations {
    Eigen::Matrix2d N{Eigen::Matrix2d::Zero()};
    Eigen::Vector2d g{0, 0};
    double chi2{0};
};

TNormalEquations accumulate(const TFit& fit,
                            const std::vector<TBeam>& beams,
                            const std::vector<std::size_t>& members,
                            const TBeamNoise& noise) {
    TNormalEquations sums;
    for (const std::size_t i : members) {
        const double sigma = fit.sigma(beams[i], noise);
        const double weight = 1 / (sigma * sigma);
        const double d = fit.distance(beams[i]);
        const Eigen::Vector2d J(-1, fit.along(beams[i]));
        sums.N += weight * J * J.transpose();
        sums.g += weight * d * J;
        sums.chi2 += weight * d * d;
    }
    return sums;
}

}  // namespace

std::optional<TFit> lineThrough(const TBeam& a, const TBeam& b) {
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double length = std::hypot(dx, dy);
    if (!(length > 1e-6)) return std::nullopt;
    return normalised((a.x * dy - a.y * dx) / length, dy, -dx);
}

std::optional<TFit> refineLine(const TFit& start,
                               const std::vector<TBeam>& beams,
                               const std::vector<std::size_t>& members,
                               const TBeamNoise& noise) {
    TFit fit = start;
    for (int i = 0; i < kIterations; ++i) {
        const TNormalEquations sums = accumulate(fit, beams, members, noise);
        if (!(sums.N.determinant() > 0)) return std::nullopt;
        const Eigen::Vector2d step = -(sums.N.inverse() * sums.g);
        const double turned = std::atan2(fit.sine, fit.cosine) + step[1];
        fit = normalised(fit.rho + step[0], std::cos(turned), std::sin(turned));
        if (!std::isfinite(fit.rho)) return std::nullopt;
    }
    const TNormalEquations sums = accumulate(fit, beams, members, noise);
    fit.covariance = sums.N.inverse();
    const double freedom = std::max<double>(1, static_cast<double>(members.size()) - 2);
    if (sums.chi2 / freedom > kRough) fit.covariance *= sums.chi2 / freedom;
    if (!fit.covariance.allFinite()) return std::nullopt;
    return fit;
}

}  // namespace salma::laser
