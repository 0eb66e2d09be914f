// SPDX-License-Identifier: BSD-3-Clause
#include <salma/landmarks/CEntitySelector.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <tuple>

namespace salma::landmarks {
namespace {

using appearance::CWallView;
using observations::TSalientRegion;

/// A salient region with the wall that it lies on.
struct TPlaced {
    TSalientRegion region;
    std::size_t wall;
    mrpt::math::TPoint2D centre;  //!< Wall coordinates (u, v) [m].
};

/// Disjoint sets of indices.
class CGroups {
 public:
    explicit CGroups(std::size_t n) : m_parent(n) {
        std::iota(m_parent.begin(), m_parent.end(), std::size_t{0});
    }
    std::size_t find(std::size_t i) {
        while (m_parent[i] != i) i = m_parent[i] = m_parent[m_parent[i]];
        return i;
    }
    void join(std::size_t i, std::size_t j) {
        const auto [a, b] = std::minmax({find(i), find(j)});
        m_parent[b] = a;
    }

 private:
    std::vector<std::size_t> m_parent;
};

/// True if both walls are pieces of one plane: all ends of b lie near the line a.
bool samePlane(const CWallView& a, const CWallView& b, double tolerance) {
    const auto& line = a.wall();
    const auto distance = [&](const mrpt::math::TPoint2D& p) {
        return std::abs(p.x * std::cos(line.alpha) + p.y * std::sin(line.alpha) - line.rho);
    };
    return distance(b.wall().from) <= tolerance && distance(b.wall().to) <= tolerance;
}

bool touch(const TSalientRegion& a, const TSalientRegion& b, double factor) {
    return std::hypot(a.x - b.x, a.y - b.y) <= factor * (a.s + b.s);
}

/// Indices of the regions whose centre is one of the pixels.
std::vector<std::size_t> inside(const std::vector<cv::Point>& pixels,
                                const std::vector<TPlaced>& placed) {
    const cv::Rect box = cv::boundingRect(pixels);
    std::vector<std::size_t> near, result;
    for (std::size_t i = 0; i < placed.size(); ++i)
        if (box.contains(cv::Point2d(placed[i].region.x, placed[i].region.y))) near.push_back(i);
    if (near.size() < 2) return {};
    cv::Mat mask = cv::Mat::zeros(box.size(), CV_8U);
    for (const auto& p : pixels) mask.at<uchar>(p - box.tl()) = 1;
    for (const auto i : near) {
        const auto& r = placed[i].region;
        const cv::Point at(static_cast<int>(r.x) - box.x, static_cast<int>(r.y) - box.y);
        if (mask.at<uchar>(at) != 0) result.push_back(i);
    }
    return result;
}

/// Smallest rectangle on the wall around the discs of all regions.
appearance::TWallRectangle boxAround(const std::vector<const TPlaced*>& group,
                                     const CWallView& view) {
    appearance::TWallRectangle box{1e9, 1e9, -1e9, -1e9};
    for (const TPlaced* p : group) {
        for (const int k : {0, 1, 2, 3}) {
            const double a = k * M_PI_2;
            const auto rim = view.toWall(
                {p->region.x + p->region.s * std::cos(a), p->region.y + p->region.s * std::sin(a)});
            const auto at = rim.value_or(p->centre);
            box = {std::min(box.u0, at.x), std::min(box.v0, at.y), std::max(box.u1, at.x),
                   std::max(box.v1, at.y)};
        }
    }
    return box;
}

TEntity entityOf(const std::vector<const TPlaced*>& group, const std::vector<CWallView>& walls) {
    TEntity entity;
    entity.wall = group.front()->wall;
    entity.box = boxAround(group, walls[entity.wall]);
    for (const TPlaced* p : group) {
        entity.regions.push_back(p->region);
        entity.saliency += p->region.Y;
    }
    return entity;
}

/// The regions that lie on a wall at a height where entities hang; the others are counted.
std::vector<TPlaced> place(const std::vector<TSalientRegion>& regions,
                           const std::vector<CWallView>& walls,
                           const TSelectionOptions& options,
                           TSelection& counts) {
    std::vector<TPlaced> placed;
    for (const auto& region : regions) {
        if (!std::isfinite(region.x + region.y) || !(region.s > 0 && region.s < 1e9)) {
            ++counts.notFinite;
            continue;
        }
        const std::size_t wall = wallOf({region.x, region.y}, walls, options.wallMargin);
        std::optional<mrpt::math::TPoint2D> at;
        if (wall < walls.size()) at = walls[wall].toWall({region.x, region.y});
        if (!at)
            ++counts.onNoWall;
        else if (!(at->y >= options.lowest && at->y <= options.highest))
            ++counts.outOfHeight;
        else
            placed.push_back({region, wall, *at});
    }
    return placed;
}

/// Calls join(i, j) for all regions that touch or lie in one area.
template <class JOIN>
void forEachJoin(const std::vector<TPlaced>& placed,
                 const std::vector<std::vector<cv::Point>>& areas,
                 double factor,
                 JOIN join) {
    for (std::size_t i = 0; i < placed.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (touch(placed[i].region, placed[j].region, factor)) join(i, j);
    for (const auto& pixels : areas) {
        const auto members = inside(pixels, placed);
        for (std::size_t k = 1; k < members.size(); ++k) join(members[0], members[k]);
    }
}

using TGroup = std::vector<const TPlaced*>;

/// Groups of regions on one plane each, in the order of `placed`; those split are counted.
std::vector<TGroup> grouped(const std::vector<TPlaced>& placed,
                            const std::vector<std::vector<cv::Point>>& areas,
                            const std::vector<CWallView>& walls,
                            const TSelectionOptions& options,
                            TSelection& counts) {
    CGroups whole(placed.size()), onPlane(placed.size());
    forEachJoin(placed, areas, options.touch, [&](std::size_t i, std::size_t j) {
        whole.join(i, j);
        const std::size_t a = placed[i].wall, b = placed[j].wall;
        if (a == b || samePlane(walls[a], walls[b], options.samePlane)) onPlane.join(i, j);
    });
    std::vector<TGroup> members(placed.size());
    std::vector<std::size_t> parts(placed.size());
    for (std::size_t i = 0; i < placed.size(); ++i) {
        members[onPlane.find(i)].push_back(&placed[i]);
        if (onPlane.find(i) == i && ++parts[whole.find(i)] == 2) ++counts.split;
    }
    members.erase(std::remove_if(members.begin(), members.end(),
                                 [](const auto& group) { return group.empty(); }),
                  members.end());
    return members;
}

double areaOf(const appearance::TWallRectangle& r) { return (r.u1 - r.u0) * (r.v1 - r.v0); }

bool ranksBefore(const TEntity& a, const TEntity& b) {
    return std::make_tuple(b.regions.size(), b.saliency, areaOf(b.box), a.regions[0].x,
                           a.regions[0].y) < std::make_tuple(a.regions.size(), a.saliency,
                                                             areaOf(a.box), b.regions[0].x,
                                                             b.regions[0].y);
}

}  // namespace

void TSelectionOptions::visit(config::COptionVisitor& v) {
    v.choice("detector", detector,
             {{"scale-saliency", EDetector::scaleSaliency},
              {"mser", EDetector::mser},
              {"both", EDetector::both},
              {"quad", EDetector::quad},
              {"external", EDetector::external}},
             "salient regions, stable ones, salient ones joined by stable ones, contours, or those "
             "of the program in [external]");
    v.number("brightness", brightness, config::between(0, 255),
             "mean grey level that darker pictures are brought to before regions are sought");
    v.number("y_min", yMin, config::atLeast(0), "least saliency Y of a salient region [nat]");
    v.integer("min_regions", minRegions, config::between(1, 1000), "regions of an entity");
    v.number("touch", touch, config::between(0, 100),
             "regions touch if nearer than this times the sum of their scales");
    v.integer("max_entities", maxEntities, config::between(1, 100),
              "landmarks taken from a picture");
    v.integer("max_tries", maxTries, config::between(1, 100),
              "entities looked at until there are so many, those with most regions first");
    v.number("lowest_m", lowest, config::between(-10, 10),
             "lowest place of a region above the floor");
    v.number("highest_m", highest, config::between(-10, 100), "highest place");
    v.number("wall_margin_m", wallMargin, config::between(0, 10),
             "how far beyond the end of a laser line the wall is believed");
    v.number("same_plane_m", samePlane, config::between(0, 1),
             "laser lines nearer than this are one plane");
}

CEntitySelector::CEntitySelector(const TSelectionOptions& options) : m_options(options) {}

std::size_t wallOf(const mrpt::math::TPoint2D& pixel,
                   const std::vector<CWallView>& walls,
                   double margin) {
    std::size_t best = walls.size();
    double nearest = 1e9;
    for (std::size_t i = 0; i < walls.size(); ++i) {
        const auto at = walls[i].toWall(pixel);
        if (!at) continue;
        const auto [from, to] = walls[i].extent();
        if (!(at->x >= from - margin && at->x <= to + margin)) continue;
        const Eigen::Vector3d point = walls[i].point(at->x, at->y);
        const auto& camera = walls[i].cameraPose();
        const double distance =
            std::hypot(point.x() - camera.x(), point.y() - camera.y(), point.z() - camera.z());
        if (distance < nearest) {
            nearest = distance;
            best = i;
        }
    }
    return best;
}

TSelection CEntitySelector::select(const TDetections& found,
                                   const std::vector<CWallView>& walls) const {
    TSelection result;
    const auto placed = place(found.regions, walls, m_options, result);
    for (const auto& group : grouped(placed, found.areas, walls, m_options, result)) {
        if (group.size() < static_cast<std::size_t>(m_options.minRegions))
            ++result.tooFewRegions;
        else
            result.entities.push_back(entityOf(group, walls));
    }
    std::sort(result.entities.begin(), result.entities.end(), ranksBefore);
    return result;
}

}  // namespace salma::landmarks
