// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/Clock.h>
#include <salma/observations/loadPicture.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace fs = std::filesystem;
using mrpt::obs::CObservationImage;

namespace salma::observations {
namespace {

cv::Mat loadEmbedded(const CObservationImage& observation) {
    if (observation.image.isEmpty())
        throw std::runtime_error("picture of sensor '" + observation.sensorLabel + "' at " +
                                 std::to_string(mrpt::Clock::toDouble(observation.timestamp)) +
                                 " s is empty");
    return observation.image.asCvMat<cv::Mat>(mrpt::img::DEEP_COPY);
}

cv::Mat loadExternal(const std::string& file) {
    std::error_code error;
    if (!fs::exists(file, error)) throw std::runtime_error(file + ": no such picture");
    if (!fs::is_regular_file(file, error)) throw std::runtime_error(file + ": is not a picture");
    if (fs::file_size(file, error) == 0) throw std::runtime_error(file + ": is empty");
    cv::Mat picture;
    try {
        picture = cv::imread(file, cv::IMREAD_UNCHANGED);
    } catch (const cv::Exception&) {
        picture.release();  // OpenCV throws for some broken files and gives nothing for others
    }
    if (picture.empty()) throw std::runtime_error(file + ": is not a picture");
    if (picture.depth() != CV_8U || (picture.channels() != 1 && picture.channels() != 3))
        throw std::runtime_error(file + ": is not a grey or colour picture of 8 bits");
    return picture;
}

}  // namespace

std::string pictureFileOf(const CObservationImage& observation, const std::string& imagesFolder) {
    if (!observation.image.isExternallyStored()) return "";
    // An absolute name stands for itself.
    return (fs::path(imagesFolder) / observation.image.getExternalStorageFile()).string();
}

cv::Mat loadPicture(const CObservationImage& observation, const std::string& imagesFolder) {
    const std::string file = pictureFileOf(observation, imagesFolder);
    return file.empty() ? loadEmbedded(observation) : loadExternal(file);
}

cv::Mat loadGrey(const CObservationImage& observation, const std::string& imagesFolder) {
    const cv::Mat picture = loadPicture(observation, imagesFolder);
    if (picture.channels() == 1) return picture;
    cv::Mat grey;
    cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
    return grey;
}

bool hasPicture(const CObservationImage& observation, const std::string& imagesFolder) {
    const std::string file = pictureFileOf(observation, imagesFolder);
    std::error_code error;
    return file.empty() ? !observation.image.isEmpty() : fs::is_regular_file(file, error);
}

}  // namespace salma::observations
