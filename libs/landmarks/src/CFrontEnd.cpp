// SPDX-License-Identifier: BSD-3-Clause
#include <salma/appearance/CPatchMatcher.h>
#include <salma/landmarks/CFrontEnd.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "warpWall.h"

namespace salma::landmarks {
namespace {

using appearance::CWallView;
using appearance::TWallRectangle;
using observations::TPatch;

/// Limits of the resolution in which borders are sought [px/m]: finer than the upper one costs time
/// and places no border better than to a centimetre.
constexpr double kCoarsest = 20, kFinest = 150;

/// True if the laser sees a nearer wall just left or right of the rectangle: then that side is
/// where the nearer wall ends, not the entity.
bool partlyHidden(const TWallRectangle& r,
                  const CWallView& wall,
                  const std::vector<CWallView>& walls) {
    constexpr double kBeside = 0.05, kNearer = 0.2;  // [m]
    const double v = (r.v0 + r.v1) / 2;
    for (const double u : {r.u0 - kBeside, r.u1 + kBeside}) {
        const auto pixel = wall.toPixel(u, v);
        if (!pixel) continue;
        const std::size_t seen = wallOf(*pixel, walls, kBeside);
        if (seen == walls.size()) continue;
        const auto at = walls[seen].toWall(*pixel);
        if ((walls[seen].point(at->x, at->y) - wall.point(u, v)).norm() > kNearer) return true;
    }
    return false;
}

bool isFinite(const mrpt::poses::CPose3D& T) {
    return std::isfinite(T.x() + T.y() + T.z() + T.yaw() + T.pitch() + T.roll());
}

void requireSize(const TView& view) {
    const int cols = static_cast<int>(view.camera.ncols),
              rows = static_cast<int>(view.camera.nrows);
    const auto size = [](int width, int height) {
        return std::to_string(width) + "x" + std::to_string(height);
    };
    if (view.grey.cols != cols || view.grey.rows != rows)
        throw std::invalid_argument("front end: the picture has " +
                                    size(view.grey.cols, view.grey.rows) + " pixels, its camera " +
                                    size(cols, rows));
}

/// The walls as the picture shows them, without those that are no number.
std::vector<CWallView> wallViews(const TView& view, TFrontEndResult& result) {
    std::vector<CWallView> walls;
    for (const auto& line : view.walls)
        if (std::isfinite(line.rho + line.alpha + line.from.x + line.from.y + line.to.x +
                          line.to.y))
            walls.emplace_back(view.camera, view.T_r_c, line);
        else
            ++result.refused["wall that is no line"];
    return walls;
}

void addCounts(const TSelection& selection, TFrontEndResult& result) {
    const auto add = [&](const char* reason, std::size_t count) {
        if (count > 0) result.refused[reason] += count;
    };
    add("region without place or size", selection.notFinite);
    add("region on no wall", selection.onNoWall);
    add("region too low or too high", selection.outOfHeight);
    add("too few regions", selection.tooFewRegions);
    result.split += selection.split;
}

/// The centre is the mean of two sides along each axis, each of them a little wrong.
void addBorderError(const CWallView& wall,
                    double sideSigma,
                    mrpt::poses::CPose3DPDFGaussian& pose) {
    const double variance = sideSigma * sideSigma / 2;
    const Eigen::Vector2d along(std::sin(wall.wall().alpha), -std::cos(wall.wall().alpha));
    auto& covariance = pose.cov;
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) covariance(i, j) += variance * along[i] * along[j];
    covariance(2, 2) += variance;
}

/// True if most regions of the entity lie in one of the patches.
bool isPartOf(const TEntity& entity, const std::vector<TPatch>& patches) {
    return std::any_of(patches.begin(), patches.end(), [&](const TPatch& patch) {
        std::vector<cv::Point2f> quad;
        for (const auto& p : patch.quad)
            quad.emplace_back(static_cast<float>(p.x), static_cast<float>(p.y));
        const auto in =
            std::count_if(entity.regions.begin(), entity.regions.end(), [&](const auto& region) {
                const cv::Point2f at(static_cast<float>(region.x), static_cast<float>(region.y));
                return cv::pointPolygonTest(quad, at, false) >= 0;
            });
        return 2 * static_cast<std::size_t>(in) > entity.regions.size();
    });
}

}  // namespace

void TFrontEndOptions::visit(config::COptionVisitor& v) {
    v.integer("min_keypoints", minKeypoints, config::between(0, 10000),
              "patches with fewer are refused; half of them do beside as many regions");
    v.number("min_size_m", minSize, config::moreThan(0), "smallest width and height of an entity");
    v.number("max_size_m", maxSize, config::moreThan(0), "largest width and height of an entity");
    v.number("max_skew_s", maxSkew, config::atLeast(0),
             "longest gap between a picture and the scan it is joined with");
    v.number("latency_camera_s", latencyCamera, config::between(-10, 10),
             "pictures were taken this long before their stamp");
}

void TFrontEndOptions::validate() const {
    if (!(minSize < maxSize)) throw std::invalid_argument("min_size_m must be below max_size_m");
}

CFrontEnd::CFrontEnd(const TSeeingOptions& options)
    : m_options(options.frontEnd),
      m_detector(options),
      m_selector(options.selection),
      m_border(options.border),
      m_rectifier(options.rectification),
      m_secondLook(options.secondLook),
      m_texture(options.texture),
      m_descriptor(options.descriptor) {
    m_options.validate();
}

TFrontEndResult CFrontEnd::process(const TView& view) const {
    if (view.grey.type() != CV_8UC1)
        throw std::invalid_argument("front end: the picture is not 8-bit grey");
    requireSize(view);
    TFrontEndResult result;
    if (!isFinite(view.T_r_c)) {
        ++result.refused["picture from an unknown pose"];
        return result;
    }
    const TDetections found = m_detector.detect(view.grey);
    if (found.regions.empty()) ++result.refused["picture without region"];
    const auto walls = wallViews(view, result);
    const TSelection selection = m_selector.select(found, walls);
    addCounts(selection, result);
    const auto wanted = static_cast<std::size_t>(m_selector.options().maxEntities);
    int tries = m_selector.options().maxTries;
    for (const auto& entity : selection.entities) {
        if (result.landmarks.size() >= wanted || tries <= 0) {
            ++result.refused["outnumbered"];
        } else if (isPartOf(entity, result.landmarks)) {
            ++result.refused["part of another entity"];
        } else {
            --tries;
            if (auto patch = landmarkOf(entity, walls, view, result))
                result.landmarks.push_back(std::move(*patch));
        }
    }
    return result;
}

mrpt::poses::CPose3DPDFGaussian CFrontEnd::poseOnWall(const CWallView& wall,
                                                      double u,
                                                      double v) const {
    auto pose = m_rectifier.pose(wall, u, v);
    addBorderError(wall, m_border.options().sideSigma, pose);
    return pose;
}

std::optional<TPatch> CFrontEnd::landmarkOf(const TEntity& entity,
                                            const std::vector<CWallView>& walls,
                                            const TView& view,
                                            TFrontEndResult& result) const {
    const auto refuse = [&](const std::string& reason) {
        ++result.refused[reason];
        return std::nullopt;
    };
    const CWallView& wall = walls[entity.wall];
    const auto border = borderOf(entity, wall, view.grey);
    if (!border) return refuse("no border");
    if (partlyHidden(*border, wall, walls)) return refuse("partly hidden by a nearer wall");
    const double width = border->u1 - border->u0, height = border->v1 - border->v0;
    if (!(std::min(width, height) >= m_options.minSize)) return refuse("too small");
    if (!(std::max(width, height) <= m_options.maxSize)) return refuse("too large");
    auto rectified = m_rectifier.rectify(view.grey, wall, *border);
    if (!rectified.patch) return refuse(appearance::asString(rectified.refusal));
    TPatch& patch = *rectified.patch;
    addBorderError(wall, m_border.options().sideSigma, patch.pose);
    patch.keypoints = m_descriptor.describe(patch);
    patch.regions = m_secondLook.describe(view.grey, wall, *border);
    if (!appearance::saysEnough(patch, static_cast<std::size_t>(m_options.minKeypoints)))
        return refuse("too few keypoints");
    patch.texture = m_texture.describe(view.grey, wall, *border);
    return std::move(rectified.patch);
}

std::optional<TWallRectangle> CFrontEnd::borderOf(const TEntity& entity,
                                                  const CWallView& wall,
                                                  const cv::Mat& grey) const {
    const double reach = m_border.options().grow + 0.15;
    const TWallRectangle area{entity.box.u0 - reach, entity.box.v0 - reach, entity.box.u1 + reach,
                              entity.box.v1 + reach};
    // A box of many metres comes from regions whose rays graze the wall.
    if (!(area.u1 - area.u0 <= 2 * m_options.maxSize + 2 * reach)) return std::nullopt;
    // As fine as the picture, else edges of distant posters would look soft.
    const auto [fineU, fineV] = wall.pixelsPerMetreOfAxes((entity.box.u0 + entity.box.u1) / 2,
                                                          (entity.box.v0 + entity.box.v1) / 2);
    const cv::Point2d resolution(std::clamp(fineU, kCoarsest, kFinest),
                                 std::clamp(fineV, kCoarsest, kFinest));
    const TWallPicture picture = warpWall(grey, wall, area, resolution);
    std::vector<cv::Point2d> centres;
    for (const auto& region : entity.regions)
        if (const auto at = wall.toWall({region.x, region.y}))
            centres.emplace_back((at->x - area.u0) * resolution.x,
                                 (area.v1 - at->y) * resolution.y);
    const auto found = m_border.find(picture.grey, picture.valid, centres, resolution);
    if (!found) return std::nullopt;
    return TWallRectangle{area.u0 + found->x / resolution.x, area.v1 - found->br().y / resolution.y,
                          area.u0 + found->br().x / resolution.x,
                          area.v1 - found->y / resolution.y};
}

}  // namespace salma::landmarks
