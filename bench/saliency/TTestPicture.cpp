// SPDX-License-Identifier: BSD-3-Clause
#include "TTestPicture.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace salma::bench {
namespace {

/// Discs of radius 2..50 px with few large ones, on a slope of grey, with noise of 4 grey levels.
cv::Mat discsAndNoise() {
    cv::Mat1b grey(768, 1024);
    cv::RNG random(1);
    for (int y = 0; y < grey.rows; ++y)
        for (int x = 0; x < grey.cols; ++x)
            grey(y, x) = cv::saturate_cast<std::uint8_t>(60 + x / 8);
    for (int i = 0; i < 4000; ++i) {
        const cv::Point centre(random.uniform(0, grey.cols), random.uniform(0, grey.rows));
        const int radius =
            static_cast<int>(2 * std::pow(25.0, std::pow(random.uniform(0.0, 1.0), 3)));
        cv::circle(grey, centre, radius, cv::Scalar(random.uniform(0, 256)), cv::FILLED);
    }
    cv::Mat noise(grey.size(), CV_16S);
    random.fill(noise, cv::RNG::NORMAL, 0, 4);
    cv::Mat noisy;
    cv::add(grey, noise, noisy, cv::noArray(), CV_8U);
    return noisy;
}

struct TSource {
    const char* name;
    std::string file;
};

}  // namespace

cv::Mat TTestPicture::resized(const cv::Size& size) const {
    cv::Mat result;
    cv::resize(grey, result, size, 0, 0, cv::INTER_AREA);
    return result;
}

std::vector<TTestPicture> testPictures(const std::string& dataFolder,
                                       const std::vector<std::string>& names,
                                       std::ostream& out) {
    const std::vector<TSource> sources{
        {"corridor", dataFolder + "/corridor_images/32.jpg"},
        {"stereo-calib", "/usr/share/mrpt/datasets/stereo-calib/0_left.jpg"},
        {"graf", dataFolder + "/homography/graf/img1.ppm"},
        {"synthetic", ""}};
    for (const auto& name : names)
        if (std::none_of(sources.begin(), sources.end(),
                         [&](const auto& s) { return s.name == name; }))
            throw std::invalid_argument("no picture is named " + name +
                                        "; there are corridor, stereo-calib, graf, synthetic");
    std::vector<TTestPicture> pictures;
    for (const auto& source : sources) {
        if (!names.empty() && std::find(names.begin(), names.end(), source.name) == names.end())
            continue;
        const cv::Mat grey =
            source.file.empty() ? discsAndNoise() : cv::imread(source.file, cv::IMREAD_GRAYSCALE);
        if (grey.empty())
            out << "notice: picture " << source.name << " left out: " << source.file
                << " cannot be read\n";
        else
            pictures.push_back({source.name, grey});
    }
    return pictures;
}

}  // namespace salma::bench
