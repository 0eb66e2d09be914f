// SPDX-License-Identifier: BSD-3-Clause
#include "recordIo.h"

#include <cmath>
#include <opencv2/core.hpp>
#include <stdexcept>

using mrpt::serialization::CArchive;

namespace salma::observations::io {
namespace {

constexpr std::size_t kMaxText = 4096;      // bytes
constexpr std::size_t kMaxSide = 1U << 13;  // [px]; a picture of a patch has a few hundred

}  // namespace

void readBytes(CArchive& in, void* data, std::size_t bytes) {
    if (bytes > 0 && in.ReadBuffer(data, bytes) != bytes)
        throw std::runtime_error("record breaks off");
}

std::size_t readCount(CArchive& in, std::size_t limit, const char* what) {
    const auto count = readNumber<std::uint32_t>(in);
    if (count > limit)
        throw std::runtime_error("record claims " + std::to_string(count) + " " + what +
                                 ", more than " + std::to_string(limit));
    return count;
}

double readFinite(CArchive& in, const char* what) {
    const auto value = readNumber<double>(in);
    if (!std::isfinite(value))
        throw std::runtime_error(std::string("record holds a ") + what + " that is no number");
    return value;
}

std::string readText(CArchive& in, const char* what) {
    std::string text(readCount(in, kMaxText, what), '\0');
    readBytes(in, text.data(), text.size());
    return text;
}

void writeText(CArchive& out, const std::string& text) {
    if (text.size() > kMaxText)
        throw std::length_error("text of " + std::to_string(text.size()) +
                                " bytes is too long for a record");
    out << text;
}

void writePose(CArchive& out, const mrpt::poses::CPose3D& pose) {
    out << pose.x() << pose.y() << pose.z() << pose.yaw() << pose.pitch() << pose.roll();
}

mrpt::poses::CPose3D readPose(CArchive& in) {
    double v[6];
    for (double& number : v) number = readFinite(in, "pose");
    return {v[0], v[1], v[2], v[3], v[4], v[5]};
}

void writeGrey(CArchive& out, const mrpt::img::CImage& picture) {
    cv::Mat pixels;
    if (!picture.isEmpty()) pixels = picture.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY);
    if (!pixels.empty() && pixels.type() != CV_8UC1)
        throw std::invalid_argument("the picture of a patch must be grey");
    if (pixels.cols > static_cast<int>(kMaxSide) || pixels.rows > static_cast<int>(kMaxSide))
        throw std::length_error("the picture of a patch is too large for a record");
    out << static_cast<std::uint32_t>(pixels.cols) << static_cast<std::uint32_t>(pixels.rows);
    // Row by row, for a view of another picture does not lie in one piece.
    for (int row = 0; row < pixels.rows; ++row)
        out.WriteBuffer(pixels.ptr(row), static_cast<std::size_t>(pixels.cols));
}

mrpt::img::CImage readGrey(CArchive& in) {
    const std::size_t columns = readCount(in, kMaxSide, "columns of a picture");
    const std::size_t rows = readCount(in, kMaxSide, "rows of a picture");
    cv::Mat pixels(0, static_cast<int>(columns), CV_8UC1);
    std::vector<std::uint8_t> row(columns);
    // Grows with what is really there, so that a false size cannot fill the memory.
    for (std::size_t i = 0; i < rows && columns > 0; ++i) {
        readBytes(in, row.data(), columns);
        pixels.push_back(cv::Mat(1, static_cast<int>(columns), CV_8UC1, row.data()));
    }
    if (pixels.empty()) return {};
    return mrpt::img::CImage(pixels, mrpt::img::DEEP_COPY);
}

}  // namespace salma::observations::io
