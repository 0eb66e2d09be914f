// SPDX-License-Identifier: BSD-3-Clause
#include "patchIo.h"

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "recordIo.h"

using mrpt::serialization::CArchive;

namespace salma::observations::io {
namespace {

void writePosePdf(CArchive& out, const mrpt::poses::CPose3DPDFGaussian& pose) {
    writePose(out, pose.mean);
    for (int row = 0; row < 6; ++row)
        for (int column = 0; column < 6; ++column) out << pose.cov(row, column);
}

mrpt::poses::CPose3DPDFGaussian readPosePdf(CArchive& in) {
    mrpt::poses::CPose3DPDFGaussian pose;
    pose.mean = readPose(in);
    for (int row = 0; row < 6; ++row)
        for (int column = 0; column < 6; ++column)
            pose.cov(row, column) = readFinite(in, "covariance");
    return pose;
}

void writeRegions(CArchive& out, const std::vector<TSalientRegion>& regions) {
    writeCount(out, regions.size(), kMaxElements);
    for (const TSalientRegion& r : regions) out << r.x << r.y << r.s << r.H << r.W << r.Y;
}

std::vector<TSalientRegion> readRegions(CArchive& in) {
    std::vector<TSalientRegion> regions;
    const std::size_t count = readCount(in, kMaxElements, "regions");
    for (std::size_t i = 0; i < count; ++i) {
        TSalientRegion& r = regions.emplace_back();
        for (double* value : {&r.x, &r.y, &r.s, &r.H, &r.W, &r.Y})
            *value = readFinite(in, "region");
    }
    return regions;
}

void writeKeypoints(CArchive& out, const std::vector<TKeypoint>& keypoints) {
    writeCount(out, keypoints.size(), kMaxElements);
    for (const TKeypoint& k : keypoints) {
        out << k.x << k.y << k.scale << k.angle;
        out.WriteBuffer(k.descriptor.data(), k.descriptor.size());
    }
}

std::vector<TKeypoint> readKeypoints(CArchive& in) {
    std::vector<TKeypoint> keypoints;
    const std::size_t count = readCount(in, kMaxElements, "keypoints");
    for (std::size_t i = 0; i < count; ++i) {
        TKeypoint& k = keypoints.emplace_back();
        for (double* value : {&k.x, &k.y, &k.scale, &k.angle}) *value = readFinite(in, "keypoint");
        readBytes(in, k.descriptor.data(), k.descriptor.size());
    }
    return keypoints;
}

/// The four corners in the picture to those of the patch [m].
cv::Mat pictureToPatch(const TPatch& patch) {
    const auto w = static_cast<float>(patch.width / 2);
    const auto h = static_cast<float>(patch.height / 2);
    const cv::Point2f metres[] = {{-w, h}, {w, h}, {w, -h}, {-w, -h}};
    cv::Point2f pixels[4];
    for (int i = 0; i < 4; ++i)
        pixels[i] = {static_cast<float>(patch.quad[static_cast<std::size_t>(i)].x),
                     static_cast<float>(patch.quad[static_cast<std::size_t>(i)].y)};
    return cv::getPerspectiveTransform(pixels, metres);
}

/// Where a pixel lies on the patch.
cv::Vec2d onPatch(const cv::Matx33d& H, double x, double y) {
    const cv::Vec3d p = H * cv::Vec3d(x, y, 1);
    return {p[0] / p[2], p[1] / p[2]};
}

/// A disc's area decides its scale: it is an ellipse on the patch.
void toMetres(TSalientRegion& r, const cv::Matx33d& H) {
    const cv::Vec2d centre = onPatch(H, r.x, r.y);
    const cv::Vec2d right = onPatch(H, r.x + 1, r.y) - centre;
    const cv::Vec2d down = onPatch(H, r.x, r.y + 1) - centre;
    r.x = centre[0];
    r.y = centre[1];
    r.s *= std::sqrt(std::abs(right[0] * down[1] - right[1] * down[0]));
}

void regionsToMetres(TPatch& patch) {
    const cv::Matx33d H = pictureToPatch(patch);
    for (auto& region : patch.regions) {
        toMetres(region, H);
        if (!(std::isfinite(region.x + region.y + region.s) && region.s > 0)) {
            patch.regions.clear();
            return;
        }
    }
}

}  // namespace

void writeCount(CArchive& out, std::size_t count, std::size_t limit) {
    if (count > limit)
        throw std::length_error("a record takes at most " + std::to_string(limit) +
                                " elements of a kind, not " + std::to_string(count));
    out << static_cast<std::uint32_t>(count);
}

void writePatch(CArchive& out, const TPatch& patch) {
    for (const auto& corner : patch.quad) out << corner.x << corner.y;
    writePosePdf(out, patch.pose);
    out << patch.width << patch.height << patch.pixelsPerMetre << patch.incidence;
    writeGrey(out, patch.picture);
    writeRegions(out, patch.regions);
    writeKeypoints(out, patch.keypoints);
    writeCount(out, patch.texture.size(), kMaxElements);
    for (const float bin : patch.texture) out << bin;
}

TPatch readPatch(CArchive& in, std::uint8_t version) {
    TPatch patch;
    for (auto& corner : patch.quad) {
        corner.x = readFinite(in, "corner");
        corner.y = readFinite(in, "corner");
    }
    patch.pose = readPosePdf(in);
    for (double* value : {&patch.width, &patch.height, &patch.pixelsPerMetre, &patch.incidence})
        *value = readFinite(in, "size of a patch");
    patch.picture = readGrey(in);
    patch.regions = readRegions(in);
    patch.keypoints = readKeypoints(in);
    const std::size_t bins = readCount(in, kMaxElements, "bins of a texture");
    for (std::size_t i = 0; i < bins; ++i) patch.texture.push_back(readNumber<float>(in));
    if (version == 0) regionsToMetres(patch);
    return patch;
}

void writePlace(CArchive& out, const TPlaceString& place) {
    writeCount(out, place.size(), kMaxElements);
    for (const TPlaceLetter& letter : place)
        out << static_cast<std::uint8_t>(letter.letter) << letter.value << letter.sigma;
}

TPlaceString readPlace(CArchive& in) {
    TPlaceString place;
    const std::size_t count = readCount(in, kMaxElements, "place letters");
    for (std::size_t i = 0; i < count; ++i) {
        TPlaceLetter& letter = place.emplace_back();
        letter.letter = static_cast<char>(readNumber<std::uint8_t>(in));
        letter.value = readFinite(in, "place letter");
        letter.sigma = readFinite(in, "place letter");
    }
    return place;
}

}  // namespace salma::observations::io
