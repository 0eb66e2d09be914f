// SPDX-License-Identifier: BSD-3-Clause
#include "fitLine.h"

#include <Eigen/Dense>
#include <algorithm>

namespace salma::laser {
namespace {

constexpr int kIterations = 4;
constexpr double kStill = 1e-7;  // a smaller step ends the refinement [m], [rad]

/// Chi-square that noise alone exceeds once in a thousand times (Wilson and Hilferty, 1931).
double rough(double freedom) {
    constexpr double kNormalQuantile = 3.09;
    const double spread = 2 / (9 * freedom);
    const double root = 1 - spread + kNormalQuantile * std::sqrt(spread);
    return freedom * root * root * root;
}

/// Brings rho to >= 0.
TFit normalised(double rho, double c, double s) {
    TFit fit;
    const double scale = (rho < 0 ? -1 : 1) / std::sqrt(c * c + s * s);
    fit.rho = std::abs(rho);
    fit.cosine = scale * c;
    fit.sine = scale * s;
    return fit;
}

/// Normal equations of one step in (rho, alpha) with the Jacobian (-1, along).
struct TNormalEquations {
    double w{0}, wt{0}, wtt{0};  // sums of weight, weight * along, ...
    double wd{0}, wdt{0}, wdd{0};

    double determinant() const { return w * wtt - wt * wt; }
    bool solvable() const { return determinant() > 0; }
    double rhoStep() const { return (wd * wtt - wdt * wt) / determinant(); }
    double alphaStep() const { return (wd * wt - wdt * w) / determinant(); }
    Eigen::Matrix2d covariance() const {
        Eigen::Matrix2d inverse;
        inverse << wtt, wt, wt, w;
        return inverse / determinant();
    }
};

TNormalEquations accumulate(const TFit& fit,
                            const std::vector<TBeam>& beams,
                            const Members& members,
                            const TBeamNoise& noise) {
    TNormalEquations sums;
    for (const auto i : members) {
        const TBeam& beam = beams[i];
        const double weight = 1 / fit.variance(beam, noise);
        const double d = fit.distance(beam), t = fit.along(beam);
        const double wd = weight * d, wt = weight * t;
        sums.w += weight;
        sums.wt += wt;
        sums.wtt += wt * t;
        sums.wd += wd;
        sums.wdt += wd * t;
        sums.wdd += wd * d;
    }
    return sums;
}

/// A small turn needs no trigonometry: its error vanishes as the steps do.
TFit stepped(const TFit& fit, double rhoStep, double turn) {
    return normalised(fit.rho + rhoStep, fit.cosine - turn * fit.sine,
                      fit.sine + turn * fit.cosine);
}

}  // namespace

std::optional<TFit> lineThrough(const TBeam& a, const TBeam& b) {
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double length2 = dx * dx + dy * dy;
    if (!(length2 > 1e-12)) return std::nullopt;
    return normalised((a.x * dy - a.y * dx) / std::sqrt(length2), dy, -dx);
}

std::optional<TFit> improveLine(const TFit& start,
                                const std::vector<TBeam>& beams,
                                const Members& members,
                                const TBeamNoise& noise) {
    const TNormalEquations sums = accumulate(start, beams, members, noise);
    if (!sums.solvable()) return std::nullopt;
    const TFit fit = stepped(start, sums.rhoStep(), sums.alphaStep());
    if (!std::isfinite(fit.rho)) return std::nullopt;
    return fit;
}

std::optional<TFit> refineLine(const TFit& start,
                               const std::vector<TBeam>& beams,
                               const Members& members,
                               const TBeamNoise& noise) {
    TFit fit = start;
    TNormalEquations sums;
    for (int i = 0; i <= kIterations; ++i) {
        sums = accumulate(fit, beams, members, noise);
        if (!sums.solvable()) return std::nullopt;
        const double rhoStep = sums.rhoStep(), turn = sums.alphaStep();
        if (std::max(std::abs(rhoStep), std::abs(turn)) < kStill) break;
        if (i == kIterations) break;
        fit = stepped(fit, rhoStep, turn);
        if (!std::isfinite(fit.rho)) return std::nullopt;
    }
    fit.covariance = sums.covariance();
    const double freedom = std::max<double>(1, static_cast<double>(members.size()) - 2);
    if (sums.wdd > rough(freedom)) fit.covariance *= sums.wdd / freedom;
    if (!fit.covariance.allFinite()) return std::nullopt;
    return fit;
}

}  // namespace salma::laser
