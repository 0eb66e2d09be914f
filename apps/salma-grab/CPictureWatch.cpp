// SPDX-License-Identifier: BSD-3-Clause
#include "CPictureWatch.h"

#include <pictureFault.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace fs = std::filesystem;
using mrpt::obs::CObservationImage;

namespace salma::apps {
namespace {

std::string text(const cv::Size& size) {
    return std::to_string(size.width) + " x " + std::to_string(size.height);
}

/// The last bytes of a file.
std::string tailOf(const std::string& file, std::streamoff bytes) {
    std::ifstream in(file, std::ios::binary | std::ios::ate);
    const std::streamoff size = in.tellg();
    if (size < bytes) return "";
    std::string tail(static_cast<std::size_t>(bytes), '\0');
    in.seekg(size - bytes);
    in.read(tail.data(), bytes);
    return tail;
}

cv::Mat greyOf(const CObservationImage& picture, const std::string& file) {
    if (!file.empty()) return cv::imread(file, cv::IMREAD_GRAYSCALE);
    cv::Mat grey = picture.image.asCvMatRef();
    if (grey.channels() == 3) cv::cvtColor(grey, grey, cv::COLOR_BGR2GRAY);
    return grey;
}

}  // namespace

CPictureWatch::CPictureWatch(std::string imagesFolder, std::function<void(const std::string&)> tell)
    : m_imagesFolder(std::move(imagesFolder)), m_tell(std::move(tell)) {}

void CPictureWatch::look(const CObservationImage& picture) {
    const std::string& camera = picture.sensorLabel;
    std::string name, fault;
    if (picture.image.isExternallyStored()) {
        name = picture.image.getExternalStorageFile();
        fault = faultOfFile((fs::path(m_imagesFolder) / name).string());
    } else if (picture.image.isEmpty()) {
        fault = "empty";
    }
    if (fault.empty()) fault = faultOfContent(picture);
    if (!fault.empty()) note(camera, fault, name);
}

std::string CPictureWatch::faultOfFile(const std::string& file) const {
    std::error_code error;
    const auto size = fs::file_size(file, error);
    if (error) return "missing: its file was not written";
    if (size == 0) return "an empty file";
    const std::string ending = fs::path(file).extension().string();
    const std::string jpegEnd = "\xff\xd9", pngEnd = "IEND";
    const bool jpeg = ending == ".jpg" || ending == ".jpeg";
    if (jpeg && tailOf(file, 2) != jpegEnd) return "cut: its file has no end";
    if (ending == ".png" && tailOf(file, 8).substr(0, 4) != pngEnd)
        return "cut: its file has no end";
    return "";
}

std::string CPictureWatch::faultOfContent(const CObservationImage& picture) {
    const std::string& camera = picture.sensorLabel;
    const auto last = m_lastLook.find(camera);
    // A clock that jumps back must not end the looking.
    if (last != m_lastLook.end() && picture.timestamp - last->second < std::chrono::seconds(1) &&
        picture.timestamp >= last->second)
        return "";
    m_lastLook[camera] = picture.timestamp;
    const cv::Mat grey = greyOf(
        picture, picture.image.isExternallyStored()
                     ? (fs::path(m_imagesFolder) / picture.image.getExternalStorageFile()).string()
                     : "");
    if (grey.empty()) return "not to be decoded";
    if (grey.depth() != CV_8U) return "";  // depth cameras
    const cv::Size expected = m_sizes.emplace(camera, grey.size()).first->second;
    if (grey.size() != expected)
        return text(grey.size()) + " instead of the first one's " + text(expected);
    return faultOf(grey);
}

void CPictureWatch::note(const std::string& camera,
                         const std::string& fault,
                         const std::string& name) {
    if (++m_faults[camera + " " + fault] == 1)
        m_tell(camera + ": a picture is " + fault + (name.empty() ? "" : " (" + name + ")"));
}

}  // namespace salma::apps
