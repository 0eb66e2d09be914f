// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/img/CImage.h>
#include <mrpt/math/wrap2pi.h>
#include <salma/appearance/CRectifier.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "lengthErrors.h"
#include "sampleWall.h"

namespace salma::appearance {
namespace {

constexpr double kBorder = 1;  // bilinear sampling needs a neighbour [px]
constexpr int kErrorSources = 10;
constexpr int kOutlineGrid = 20;  // places per axis at which a rectangle's visible share is taken
constexpr double kSurelySigmas = 2;  // a view is coarse if its resolution is so, with this margin

using ErrorVector = Eigen::Matrix<double, kErrorSources, 1>;

/// Corners and middles of the sides, clockwise from the top left; corners are the even ones.
std::array<mrpt::math::TPoint2D, 8> outline(const TWallRectangle& r) {
    const double um = (r.u0 + r.u1) / 2;
    const double vm = (r.v0 + r.v1) / 2;
    return {{{r.u0, r.v1},
             {um, r.v1},
             {r.u1, r.v1},
             {r.u1, vm},
             {r.u1, r.v0},
             {um, r.v0},
             {r.u0, r.v0},
             {r.u0, vm}}};
}

/// Coarsest resolution anywhere on the rectangle along u and along v [px/m].
std::pair<double, double> coarsest(const CWallView& view, const TWallRectangle& r) {
    std::pair<double, double> least =
        view.pixelsPerMetreOfAxes((r.u0 + r.u1) / 2, (r.v0 + r.v1) / 2);
    for (const auto& p : outline(r)) {
        const auto here = view.pixelsPerMetreOfAxes(p.x, p.y);
        least = {std::min(least.first, here.first), std::min(least.second, here.second)};
    }
    return least;
}

/// Share of the rectangle that the picture shows; 0 if a part lies behind the camera.
double visibleShare(const CWallView& view, const TWallRectangle& r) {
    bool all = true;
    for (const auto& p : outline(r)) {
        const auto pixel = view.toPixel(p.x, p.y);
        if (!pixel) return 0;
        all = all && view.inPicture(*pixel, kBorder);
    }
    if (all) return 1;
    int seen = 0;
    for (int i = 0; i < kOutlineGrid; ++i)
        for (int j = 0; j < kOutlineGrid; ++j) {
            const auto pixel = view.toPixel(r.u0 + (i + 0.5) / kOutlineGrid * (r.u1 - r.u0),
                                            r.v0 + (j + 0.5) / kOutlineGrid * (r.v1 - r.v0));
            seen += pixel && view.inPicture(*pixel, kBorder) ? 1 : 0;
        }
    return static_cast<double>(seen) / (kOutlineGrid * kOutlineGrid);
}

cv::Size gridOf(const TWallRectangle& r, double pixelsPerMetre) {
    return {std::max(1, static_cast<int>(std::lround((r.u1 - r.u0) * pixelsPerMetre))),
            std::max(1, static_cast<int>(std::lround((r.v1 - r.v0) * pixelsPerMetre)))};
}

/// Pose (x, y, z, yaw) of the patch if the given errors were in line, pixel, camera pose and wall.
Eigen::Vector4d disturbedPose(const CWallView& view,
                              const mrpt::math::TPoint2D& pixel,
                              const ErrorVector& e) {
    laser::TLine wall = view.wall();
    wall.rho += e[0];
    wall.alpha += e[1];
    const mrpt::poses::CPose3D& T = view.cameraPose();
    const mrpt::poses::CPose3D T_r_c =  // small rotations about the robot's axes
        mrpt::poses::CPose3D(T.x() + e[4], T.y() + e[5], T.z() + e[6], 0, 0, 0) +
        mrpt::poses::CPose3D(0, 0, 0, e[9], e[8], e[7]) +
        mrpt::poses::CPose3D(0, 0, 0, T.yaw(), T.pitch(), T.roll());
    const CWallView disturbed(view.camera(), T_r_c, wall);
    const auto uv = disturbed.toWall({pixel.x + e[2], pixel.y + e[3]});
    if (!uv) throw std::invalid_argument("the patch's centre is not visible on the wall");
    const Eigen::Vector3d X = disturbed.point(uv->x, uv->y);
    return {X.x(), X.y(), X.z(), wall.alpha - M_PI_2};
}

}  // namespace

void TRectificationOptions::visit(config::COptionVisitor& v) {
    using namespace config;
    v.number("px_per_m_min", minPixelsPerMetre, moreThan(0), "coarser views are refused");
    v.number("px_per_m_max", maxPixelsPerMetre, moreThan(0), "finer views are reduced to this");
    v.number("outside_max", maxOutside, between(0, 0.5),
             "share of a rectangle that may lie outside the picture");
    v.degrees("incidence_max_deg", maxIncidence, insideOf(0, 90),
              "more slanting views are refused");
    v.number("size_min_m", minSize, moreThan(0), "smallest width and height of a patch");
    v.number("size_max_m", maxSize, moreThan(0), "largest width and height of a patch");
    v.number("camera_sigma_px", cameraSigma, atLeast(0), "noise of a place in the picture");
    v.degrees("extrinsics_sigma_deg", extrinsicsSigma, between(0, 45),
              "uncertainty of each angle of the camera on the robot");
    v.number("extrinsics_sigma_m", extrinsicsSigmaXyz, atLeast(0),
             "uncertainty of each coordinate of the camera on the robot");
    v.number("wall_sigma_m", wallSigma, atLeast(0),
             "how far a poster stands off the line of the wall");
    v.number("height_sigma_m", heightSigma, atLeast(0), "prior of the height: uneven floor");
    v.degrees("tilt_sigma_deg", tiltSigma, between(0, 45), "prior of the wall's lean");
}

void TRectificationOptions::validate() const {
    if (!(minPixelsPerMetre <= maxPixelsPerMetre))
        throw std::invalid_argument("[rectification] px_per_m_min must not be above px_per_m_max");
    if (!(minSize < maxSize))
        throw std::invalid_argument("[rectification] size_min_m must be below size_max_m");
}

const char* asString(ERefusal reason) {
    switch (reason) {
        case ERefusal::none:
            return "none";
        case ERefusal::noPicture:
            return "no picture";
        case ERefusal::badWall:
            return "bad wall";
        case ERefusal::badRectangle:
            return "bad rectangle";
        case ERefusal::outsidePicture:
            return "outside picture";
        case ERefusal::grazing:
            return "grazing";
        case ERefusal::coarse:
            return "coarse";
    }
    return "unknown";
}

CRectifier::CRectifier(const TRectificationOptions& options) : m_options(options) {
    m_options.validate();
}

ERefusal CRectifier::check(const cv::Mat& grey,
                           const CWallView& view,
                           const TWallRectangle& r) const {
    if (grey.empty() || grey.cols != static_cast<int>(view.camera().ncols) ||
        grey.rows != static_cast<int>(view.camera().nrows))
        return ERefusal::noPicture;
    if (!view.wall().covariance.allFinite()) return ERefusal::badWall;
    const auto allowed = [&](double size) {
        return size >= m_options.minSize && size <= m_options.maxSize;
    };
    if (!allowed(r.u1 - r.u0) || !allowed(r.v1 - r.v0)) return ERefusal::badRectangle;
    if (!(visibleShare(view, r) >= 1 - m_options.maxOutside)) return ERefusal::outsidePicture;
    if (!(view.incidence((r.u0 + r.u1) / 2, (r.v0 + r.v1) / 2) <= m_options.maxIncidence))
        return ERefusal::grazing;
    return ERefusal::none;
}

bool CRectifier::surelyCoarse(const observations::TPatch& patch,
                              const std::pair<double, double>& resolution) const {
    const TLengthErrors errors = lengthErrors(patch);
    const double u = resolution.first * (1 + kSurelySigmas * std::sqrt(errors.u));
    const double v = resolution.second * (1 + kSurelySigmas * std::sqrt(errors.v));
    return !(std::min(u, v) >= m_options.minPixelsPerMetre);
}

TRectification CRectifier::rectify(const cv::Mat& grey,
                                   const CWallView& view,
                                   const TWallRectangle& r) const {
    if (!grey.empty() && grey.type() != CV_8UC1)
        throw std::invalid_argument("rectification needs a grey picture of 8 bits");
    TRectification result;
    result.refusal = check(grey, view, r);
    if (result.refusal != ERefusal::none) return result;
    observations::TPatch patch;
    patch.width = r.u1 - r.u0;
    patch.height = r.v1 - r.v0;
    patch.pose = pose(view, (r.u0 + r.u1) / 2, (r.v0 + r.v1) / 2);
    patch.incidence = view.incidence((r.u0 + r.u1) / 2, (r.v0 + r.v1) / 2);
    const auto coarse = coarsest(view, r);
    if (surelyCoarse(patch, coarse)) return {std::nullopt, ERefusal::coarse};
    patch.pixelsPerMetre =
        std::min(m_options.maxPixelsPerMetre, std::min(coarse.first, coarse.second));
    const cv::Mat picture = sampleWall(grey, view, r, gridOf(r, patch.pixelsPerMetre)).grey;
    patch.picture = mrpt::img::CImage(picture, mrpt::img::DEEP_COPY);
    const auto corners = outline(r);
    for (std::size_t i = 0; i < patch.quad.size(); ++i)
        patch.quad[i] = *view.toPixel(corners[2 * i].x, corners[2 * i].y);
    result.patch = std::move(patch);
    return result;
}

mrpt::poses::CPose3DPDFGaussian CRectifier::pose(const CWallView& view, double u, double v) const {
    const auto pixel = view.toPixel(u, v);
    if (!pixel) throw std::invalid_argument("the patch's centre is not visible on the wall");
    Eigen::Matrix<double, kErrorSources, kErrorSources> Q;
    Q.setZero();
    Q.topLeftCorner<2, 2>() = view.wall().covariance;
    Q(0, 0) += m_options.wallSigma * m_options.wallSigma;
    Q(2, 2) = Q(3, 3) = m_options.cameraSigma * m_options.cameraSigma;
    Q(4, 4) = Q(5, 5) = Q(6, 6) = m_options.extrinsicsSigmaXyz * m_options.extrinsicsSigmaXyz;
    Q(7, 7) = Q(8, 8) = Q(9, 9) = m_options.extrinsicsSigma * m_options.extrinsicsSigma;
    Eigen::Matrix<double, 4, kErrorSources> J;
    for (int i = 0; i < kErrorSources; ++i) {
        const double h = i == 2 || i == 3 ? 1e-2 : 1e-5;  // pixels are coarser than metres
        ErrorVector e = ErrorVector::Zero();
        e[i] = h;
        J.col(i) = (disturbedPose(view, *pixel, e) - disturbedPose(view, *pixel, -e)) / (2 * h);
    }
    Eigen::Matrix4d P = J * Q * J.transpose();
    P(2, 2) += m_options.heightSigma * m_options.heightSigma;
    const Eigen::Vector3d X = view.point(u, v);
    mrpt::poses::CPose3DPDFGaussian out;
    // Rz(yaw) Rx(90 deg): x along the wall to the right, y up, z out of the wall
    out.mean = mrpt::poses::CPose3D(X.x(), X.y(), X.z(),
                                    mrpt::math::wrapToPi(view.wall().alpha - M_PI_2), 0, M_PI_2);
    out.cov.setZero();
    out.cov.asEigen().topLeftCorner<4, 4>() = P;
    out.cov(4, 4) = out.cov(5, 5) = m_options.tiltSigma * m_options.tiltSigma;
    return out;
}

}  // namespace salma::appearance
