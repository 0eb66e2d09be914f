// SPDX-License-Identifier: BSD-3-Clause
#include "CPlanePictures.h"

#include <salma/appearance/rectifyQuad.h>
#include <salma/saliency/regionFiles.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace salma::bench {
namespace {

using mrpt::math::TPoint2D;

constexpr double kHeight = 1;     // of every rectangle [m]
constexpr double kMargin = 2;     // of a rectangle from a picture's border [px]
constexpr double kCoarsest = 40;  // as [rectification] has it [px/m]
constexpr double kFinest = 400;   // the same
constexpr double kDistance = 3;   // from which the rectified picture is seen [m]

std::string fileOf(const std::string& folder, int k, const std::string& data) {
    const std::string base = data + "/homography/" + folder + "/";
    if (folder == "churchill") return base + std::to_string(k) + ".png";
    return base + "img" + std::to_string(k) + (folder == "graf" ? ".ppm" : ".pgm");
}

std::string mapOf(const std::string& folder, int k, const std::string& data) {
    const std::string base = data + "/homography/" + folder + "/";
    return base +
           (folder == "churchill" ? "H_1_" + std::to_string(k) : "H1to" + std::to_string(k) + "p");
}

bool inside(const Corners& corners, const cv::Mat& picture) {
    return std::all_of(corners.begin(), corners.end(), [&](const TPoint2D& p) {
        return p.x >= kMargin && p.y >= kMargin && p.x <= picture.cols - 1 - kMargin &&
               p.y <= picture.rows - 1 - kMargin;
    });
}

double length(const TPoint2D& a, const TPoint2D& b) { return std::hypot(b.x - a.x, b.y - a.y); }

/// Longest and shortest that a quadrilateral's width and height are [px].
struct TSides {
    double across, down;  // the longer of two opposite sides
    double leastAcross, leastDown;
};

TSides sidesOf(const Corners& c) {
    const double top = length(c[0], c[1]), bottom = length(c[3], c[2]);
    const double left = length(c[0], c[3]), right = length(c[1], c[2]);
    return {std::max(top, bottom), std::max(left, right), std::min(top, bottom),
            std::min(left, right)};
}

}  // namespace

Corners mapped(const cv::Matx33d& H, const Corners& points) {
    Corners out;
    for (const auto& p : points) {
        const cv::Vec3d q = H * cv::Vec3d(p.x, p.y, 1);
        out.emplace_back(q[0] / q[2], q[1] / q[2]);
    }
    return out;
}

Corners whole(const cv::Mat& picture) {
    const double right = picture.cols - 0.5, bottom = picture.rows - 0.5;
    return {{-0.5, -0.5}, {right, -0.5}, {right, bottom}, {-0.5, bottom}};
}

CPlanePictures CPlanePictures::ofSet(const std::string& data, const std::string& folder) {
    CPlanePictures out;
    for (int k = 1; k <= 6; ++k) {
        const auto file = fileOf(folder, k, data);
        out.m_pictures.push_back(cv::imread(file, cv::IMREAD_GRAYSCALE));
        if (out.m_pictures.back().empty()) throw std::runtime_error(file + ": cannot be read");
        out.m_maps.push_back(k == 1 ? cv::Matx33d::eye()
                                    : saliency::readHomography(mapOf(folder, k, data)));
    }
    return out;
}

double CPlanePictures::angle(std::size_t k) const {
    const auto corners = common(k);
    const TPoint2D middle((corners[0].x + corners[2].x) / 2, (corners[0].y + corners[2].y) / 2);
    const auto at =
        mapped(m_maps[k], {middle, {middle.x + 0.5, middle.y}, {middle.x, middle.y + 0.5}});
    const cv::Matx22d J(at[1].x - at[0].x, at[2].x - at[0].x, at[1].y - at[0].y, at[2].y - at[0].y);
    cv::Matx21d singular;
    cv::Matx22d U, V;
    cv::SVD::compute(J, singular, U, V);
    return std::acos(std::clamp(singular(1) / singular(0), 0.0, 1.0));
}

Corners CPlanePictures::common(std::size_t k) const {
    constexpr int kGrid = 20;
    const cv::Mat& first = m_pictures[0];
    for (double share = 0.95; share > 0.1; share -= 0.05)
        for (int i = 0; i <= kGrid; ++i)
            for (int j = 0; j <= kGrid; ++j) {
                // nearest to the middle first
                const auto place = [&](int n) {
                    return ((n + 1) / 2) * (n % 2 == 0 ? 1 : -1) + kGrid / 2;
                };
                const double width = share * first.cols, height = share * first.rows;
                const double x = (first.cols - 1 - width) * place(i) / kGrid;
                const double y = (first.rows - 1 - height) * place(j) / kGrid;
                const Corners corners{
                    {x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
                if (inside(corners, first) && inside(inPicture(corners, k), m_pictures[k]))
                    return corners;
            }
    throw std::runtime_error("two pictures of a plane show nothing in common");
}

Corners CPlanePictures::inPicture(const Corners& ofFirst, std::size_t k) const {
    return mapped(m_maps.at(k), ofFirst);
}

std::optional<observations::TPatch> patchOf(const cv::Mat& grey,
                                            const Corners& corners,
                                            double aspect) {
    const double width = aspect * kHeight;
    const TSides sides = sidesOf(corners);
    // as fine as the finer axis at first, so that nothing is skipped; then as the coarser one
    const cv::Size fine(std::max(1, cvRound(sides.across)), std::max(1, cvRound(sides.down)));
    const double resolution =
        std::min({sides.leastAcross / width, sides.leastDown / kHeight, kFinest});
    if (!(resolution >= kCoarsest)) return std::nullopt;
    cv::Mat front = appearance::rectifyQuad(grey, corners, fine);
    if (front.empty()) return std::nullopt;
    const cv::Size size(cvRound(width * resolution), cvRound(kHeight * resolution));
    cv::resize(front, front, size, 0, 0, cv::INTER_AREA);

    mrpt::img::TCamera camera;
    camera.ncols = static_cast<std::uint32_t>(size.width);
    camera.nrows = static_cast<std::uint32_t>(size.height);
    const double focal = resolution * kDistance;
    camera.setIntrinsicParamsFromValues(focal, focal, (size.width - 1) / 2.0,
                                        (size.height - 1) / 2.0);
    laser::TLine wall;
    wall.rho = kDistance;
    wall.alpha = 0;
    wall.from = {kDistance, -10};
    wall.to = {kDistance, 10};
    wall.covariance << 1e-4, 0, 0, 1e-4;
    const appearance::CWallView view(camera, mrpt::poses::CPose3D(0, 0, 1, -M_PI_2, 0, -M_PI_2),
                                     wall);
    const appearance::TWallRectangle place{-width / 2, 1 - kHeight / 2, width / 2, 1 + kHeight / 2};
    auto patch = appearance::CRectifier().rectify(front, view, place).patch;
    if (!patch) return std::nullopt;
    patch->keypoints = appearance::CPatchDescriptor().describe(*patch);
    patch->regions = appearance::CRegionDescriptor().describe(front, view, place);
    return patch;
}

}  // namespace salma::bench
