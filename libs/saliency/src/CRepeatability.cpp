// SPDX-License-Identifier: BSD-3-Clause
#include <salma/saliency/CRepeatability.h>
#include <salma/saliency/ellipseGeometry.h>
#include <salma/saliency/nonRedundantCount.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <tuple>

namespace salma::saliency {
namespace {

/// Centres farther apart than this many radii never correspond, as in the survey's program.
constexpr double kMostRadiiApart = 4;

/// Regions that both pictures show whole.
struct TCommonRegions {
    std::vector<std::size_t> indices;  //!< Among all regions of the picture.
    std::vector<TEllipse> own;         //!< In their own picture.
    std::vector<TEllipse> mapped;      //!< In the other.
};

bool isInside(const TEllipse& ellipse, const cv::Size& picture) {
    const cv::Size2d half = halfBox(ellipse);
    return ellipse.u - half.width >= 0 && ellipse.u + half.width <= picture.width - 1 &&
           ellipse.v - half.height >= 0 && ellipse.v + half.height <= picture.height - 1;
}

double depth(const cv::Matx33d& H, double x, double y) {
    return H(2, 0) * x + H(2, 1) * y + H(2, 2);
}

TCommonRegions commonRegions(const TRegionView& view,
                             const cv::Size& other,
                             const cv::Matx33d& H_other_view) {
    const double inFront = depth(H_other_view, view.picture.width / 2.0, view.picture.height / 2.0);
    TCommonRegions common;
    for (std::size_t i = 0; i < view.regions.size(); ++i) {
        const TEllipse& region = view.regions[i];
        const auto image = mapped(H_other_view, region);
        // What lies beyond the horizon, from the picture's middle, would appear upside down.
        if (!image || !(depth(H_other_view, region.u, region.v) * inFront > 0)) continue;
        if (!isInside(region, view.picture) || !isInside(*image, other)) continue;
        common.indices.push_back(i);
        common.own.push_back(region);
        common.mapped.push_back(*image);
    }
    return common;
}

/// An ellipse enlarged about its centre, which is moved to (u, v).
TEllipse enlarged(const TEllipse& e, double factor, double u, double v) {
    const double square = factor * factor;
    return {u, v, e.a / square, e.b / square, e.c / square};
}

/// A region of the first picture, with which others are compared.
class CNormalisedRegion {
 public:
    CNormalisedRegion(const TEllipse& region, const TRepeatabilityOptions& options)
        : m_region(region),
          m_radius(region.radius()),
          m_factor(options.normalisedRadius / m_radius),
          m_normalised(enlarged(region, m_factor, 0, 0)),
          m_maxError(options.maxOverlapError) {}

    /// Columns within which all regions lie that can correspond.
    double reach() const {
        const double reach = kMostRadiiApart * m_radius;
        return centreLiesInside() ? std::min(reach, halfBox(m_normalised).width) : reach;
    }

    /// 1 for regions that cannot correspond, found without their overlap.
    double overlapErrorWith(const TEllipse& other) const {
        const double dx = other.u - m_region.u;
        const double dy = other.v - m_region.v;
        const auto& [u, v, a, b, c] = m_normalised;
        if (!(std::hypot(dx, dy) < kMostRadiiApart * m_radius)) return 1;
        if (centreLiesInside() && !(a * dx * dx + 2 * b * dx * dy + c * dy * dy < 1)) return 1;
        const double growth = other.radius() / m_radius;
        const double smallerByLarger = std::pow(std::min(growth, 1 / growth), 2);
        if (!(1 - smallerByLarger < m_maxError)) return 1;  // the one within the other at best
        return overlapError(m_normalised, enlarged(other, m_factor, dx, dy));
    }

 private:
    /// A line through the centre of an ellipse halves it. So one whose centre lies outside a convex
    /// region has at most half of its area there, and their overlap error is 0.5 or more.
    bool centreLiesInside() const { return m_maxError <= 0.5; }

    TEllipse m_region;
    double m_radius;
    double m_factor;
    TEllipse m_normalised;  //!< About (0, 0).
    double m_maxError;
};

/// Finds the ellipses whose centres lie between two columns.
class CColumnOrder {
 public:
    explicit CColumnOrder(const std::vector<TEllipse>& ellipses) : m_ellipses(ellipses) {
        m_order.resize(ellipses.size());
        std::iota(m_order.begin(), m_order.end(), std::size_t{0});
        std::sort(m_order.begin(), m_order.end(), [&](std::size_t i, std::size_t j) {
            return std::tie(ellipses[i].u, i) < std::tie(ellipses[j].u, j);
        });
    }

    std::vector<std::size_t> within(double middle, double reach) const {
        auto next = std::lower_bound(
            m_order.begin(), m_order.end(), middle - reach,
            [&](std::size_t i, double column) { return m_ellipses[i].u < column; });
        std::vector<std::size_t> found;
        for (; next != m_order.end() && m_ellipses[*next].u <= middle + reach; ++next)
            found.push_back(*next);
        return found;
    }

 private:
    const std::vector<TEllipse>& m_ellipses;
    std::vector<std::size_t> m_order;
};

/// Takes pairs best first, each region once.
std::vector<TCorrespondence> oneToOne(std::vector<TCorrespondence> pairs,
                                      std::size_t firstCount,
                                      std::size_t secondCount) {
    std::sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) {
        return std::tie(a.overlapError, a.first, a.second) <
               std::tie(b.overlapError, b.first, b.second);
    });
    std::vector<bool> firstTaken(firstCount, false);
    std::vector<bool> secondTaken(secondCount, false);
    std::vector<TCorrespondence> taken;
    for (const auto& pair : pairs) {
        if (firstTaken[pair.first] || secondTaken[pair.second]) continue;
        firstTaken[pair.first] = secondTaken[pair.second] = true;
        taken.push_back(pair);
    }
    return taken;
}

double ratio(double part, std::size_t whole) {
    return whole == 0 ? 0 : part / static_cast<double>(whole);
}

}  // namespace

void TRepeatabilityOptions::visit(config::COptionVisitor& v) {
    v.number("max_overlap_error", maxOverlapError, config::insideOf(0, 1),
             "overlap error below which two regions correspond");
    v.number("normalised_radius_px", normalisedRadius, config::moreThan(0),
             "radius to which regions are brought before their overlap is measured");
    v.number("window_scale", windowScale, config::moreThan(0),
             "size of a descriptor's window, in sizes of its region");
}

double TRepeatability::rate() const {
    return ratio(static_cast<double>(correspondences.size()), std::min(firstCommon, secondCommon));
}

double TRepeatability::nonRedundantRate() const {
    return ratio(nonRedundantCorrespondences, std::min(firstCommon, secondCommon));
}

CRepeatability::CRepeatability(const TRepeatabilityOptions& options) : m_options(options) {
    m_options.validate();
}

TRepeatability CRepeatability::compare(const TRegionView& first,
                                       const TRegionView& second,
                                       const cv::Matx33d& H_2_1) const {
    if (!isInvertible(H_2_1)) throw std::invalid_argument("a homography is singular or not finite");
    const auto inFirst = commonRegions(first, second.picture, H_2_1);
    const auto inSecond = commonRegions(second, first.picture, H_2_1.inv());
    TRepeatability result;
    result.firstCommon = inFirst.own.size();
    result.secondCommon = inSecond.own.size();
    result.firstNonRedundant = nonRedundantCount(inFirst.own, m_options.windowScale);
    result.secondNonRedundant = nonRedundantCount(inSecond.own, m_options.windowScale);
    result.correspondences = oneToOne(overlapping(inFirst.own, inSecond.mapped), inFirst.own.size(),
                                      inSecond.own.size());
    std::vector<TEllipse> repeated;
    for (auto& pair : result.correspondences) {
        repeated.push_back(inFirst.own[pair.first]);
        pair.first = inFirst.indices[pair.first];
        pair.second = inSecond.indices[pair.second];
    }
    result.nonRedundantCorrespondences = nonRedundantCount(repeated, m_options.windowScale);
    return result;
}

/// All pairs whose overlap error is small enough, of regions in one picture.
std::vector<TCorrespondence> CRepeatability::overlapping(
    const std::vector<TEllipse>& first, const std::vector<TEllipse>& second) const {
    const CColumnOrder order(second);
    std::vector<TCorrespondence> pairs;
    for (std::size_t i = 0; i < first.size(); ++i) {
        const CNormalisedRegion region(first[i], m_options);
        for (const std::size_t j : order.within(first[i].u, region.reach())) {
            const double error = region.overlapErrorWith(second[j]);
            if (error < m_options.maxOverlapError) pairs.push_back({i, j, error});
        }
    }
    return pairs;
}

}  // namespace salma::saliency
