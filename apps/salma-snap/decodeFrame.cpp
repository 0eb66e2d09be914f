// SPDX-License-Identifier: BSD-3-Clause
#include "decodeFrame.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <array>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace salma::apps {
namespace {

enum class ELayout { packed, planar, jpeg };

struct TDecoder {
    std::uint32_t fourcc;
    ELayout layout;
    int channels;    //!< Bytes for a pixel in a packed format.
    int conversion;  //!< cv::COLOR_...; -1 for none.
};

constexpr std::array<TDecoder, 10> kDecoders = {{
    {V4L2_PIX_FMT_YUYV, ELayout::packed, 2, cv::COLOR_YUV2BGR_YUYV},
    {V4L2_PIX_FMT_UYVY, ELayout::packed, 2, cv::COLOR_YUV2BGR_UYVY},
    {V4L2_PIX_FMT_YVYU, ELayout::packed, 2, cv::COLOR_YUV2BGR_YVYU},
    {V4L2_PIX_FMT_BGR24, ELayout::packed, 3, -1},
    {V4L2_PIX_FMT_RGB24, ELayout::packed, 3, cv::COLOR_RGB2BGR},
    {V4L2_PIX_FMT_GREY, ELayout::packed, 1, -1},
    {V4L2_PIX_FMT_YUV420, ELayout::planar, 1, cv::COLOR_YUV2BGR_I420},
    {V4L2_PIX_FMT_NV12, ELayout::planar, 1, cv::COLOR_YUV2BGR_NV12},
    {V4L2_PIX_FMT_MJPEG, ELayout::jpeg, 0, -1},
    {V4L2_PIX_FMT_JPEG, ELayout::jpeg, 0, -1},
}};

const TDecoder* decoderOf(std::uint32_t fourcc) {
    const auto* const found =
        std::find_if(kDecoders.begin(), kDecoders.end(),
                     [fourcc](const TDecoder& decoder) { return decoder.fourcc == fourcc; });
    return found == kDecoders.end() ? nullptr : found;
}

[[noreturn]] void tooShort(std::size_t bytes, std::size_t wanted) {
    throw std::runtime_error("cut: " + std::to_string(bytes) + " bytes instead of " +
                             std::to_string(wanted));
}

cv::Mat decodeJpeg(const std::vector<std::uint8_t>& bytes) {
    // Drivers may put zeros behind the end mark.
    const auto last = std::find_if(bytes.rbegin(), bytes.rend(), [](auto b) { return b != 0; });
    const auto size = static_cast<std::size_t>(last.base() - bytes.begin());
    if (size < 4 || bytes[size - 2] != 0xFF || bytes[size - 1] != 0xD9)
        throw std::runtime_error("cut: a JPEG picture of " + std::to_string(size) +
                                 " bytes without its end");
    cv::Mat picture = cv::imdecode(bytes, cv::IMREAD_COLOR);
    if (picture.empty()) throw std::runtime_error("not to be decoded");
    return picture;
}

cv::Mat decodeRaw(const TDecoder& decoder,
                  const CVideoDevice::TFormat& format,
                  const std::vector<std::uint8_t>& bytes) {
    const bool planar = decoder.layout == ELayout::planar;
    const auto width = static_cast<std::size_t>(format.width);
    const auto line = std::max<std::size_t>(format.bytesPerLine,
                                            width * static_cast<std::size_t>(decoder.channels));
    if (planar && line != width)
        throw std::runtime_error("not to be decoded: its planes have gaps between their lines");
    const int rows = planar ? format.height * 3 / 2 : format.height;
    const std::size_t wanted = line * static_cast<std::size_t>(rows);
    if (bytes.size() < wanted) tooShort(bytes.size(), wanted);
    const cv::Mat raw(rows, format.width, CV_8UC(decoder.channels),
                      const_cast<std::uint8_t*>(bytes.data()), line);
    if (decoder.conversion < 0) return raw.clone();
    cv::Mat picture;
    cv::cvtColor(raw, picture, decoder.conversion);
    return picture;
}

bool alternates(std::uint32_t field) {
    return field == V4L2_FIELD_INTERLACED || field == V4L2_FIELD_INTERLACED_TB ||
           field == V4L2_FIELD_INTERLACED_BT;
}

}  // namespace

bool canDecode(std::uint32_t fourcc) { return decoderOf(fourcc) != nullptr; }

cv::Mat decodeFrame(const CVideoDevice::TFormat& format, const std::vector<std::uint8_t>& bytes) {
    const TDecoder* const decoder = decoderOf(format.fourcc);
    if (decoder == nullptr) throw std::runtime_error("of a pixel format that is not known");
    cv::Mat picture =
        decoder->layout == ELayout::jpeg ? decodeJpeg(bytes) : decodeRaw(*decoder, format, bytes);
    if (picture.cols != format.width || picture.rows != format.height)
        throw std::runtime_error("of another size: " + std::to_string(picture.cols) + " x " +
                                 std::to_string(picture.rows));
    return picture;
}

cv::Mat deinterlace(const cv::Mat& picture, std::uint32_t field, EDeinterlace how) {
    if (how == EDeinterlace::automatic)
        how = alternates(field) ? EDeinterlace::line : EDeinterlace::none;
    if (how == EDeinterlace::none || picture.rows < 3) return picture;
    cv::Mat result;
    if (how == EDeinterlace::blend) {
        const cv::Mat kernel = (cv::Mat_<float>(3, 1) << 0.25F, 0.5F, 0.25F);
        cv::filter2D(picture, result, -1, kernel);
        return result;
    }
    result = picture.clone();
    for (int row = 1; row < picture.rows; row += 2) {
        const cv::Mat above = picture.row(row - 1);
        const cv::Mat below = row + 1 < picture.rows ? picture.row(row + 1) : above;
        cv::Mat between = result.row(row);
        cv::addWeighted(above, 0.5, below, 0.5, 0, between);
    }
    return result;
}

}  // namespace salma::apps
