// SPDX-License-Identifier: BSD-3-Clause
#include "TCase.h"

#include <opencv2/core/utility.hpp>
#include <opencv2/features2d.hpp>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "plainScaleSaliency.h"

namespace salma::bench {
namespace {

using saliency::ESimd;

constexpr std::pair<const char*, ESimd> kSets[] = {
    {"auto", ESimd::automatic},   {"avx512dl", ESimd::avx512dl}, {"avx512", ESimd::avx512},
    {"avx2", ESimd::avx2},        {"sse4", ESimd::sse4},         {"neon", ESimd::neon},
    {"portable", ESimd::portable}};

}  // namespace

std::string TCase::name() const {
    std::ostringstream out;
    out << picture << "/" << text(size) << "/" << method << "/";
    if (isOurs() && yMin > 0)
        out << "T" << yMin;
    else
        out << "all";
    out << "/" << threads;
    if (scaleMax != 33) out << "/scales to " << scaleMax;
    return out.str();
}

saliency::TScaleSaliencyOptions TCase::options() const {
    saliency::TScaleSaliencyOptions o;
    o.scaleMax = scaleMax;
    o.threads = threads;
    if (isOurs()) o.simd = simdNamed(method);
    return o;
}

std::function<std::size_t(const cv::Mat&)> TCase::detector() const {
    const int forOpenCv = threads;
    if (method == "SIFT")
        return [forOpenCv, sift = cv::SIFT::create()](const cv::Mat& grey) {
            cv::setNumThreads(forOpenCv);
            std::vector<cv::KeyPoint> points;
            cv::Mat descriptors;
            sift->detectAndCompute(grey, cv::noArray(), points, descriptors);
            return points.size();
        };
    if (method == "MSER")
        return [forOpenCv, mser = cv::MSER::create()](const cv::Mat& grey) {
            cv::setNumThreads(forOpenCv);
            std::vector<std::vector<cv::Point>> regions;
            std::vector<cv::Rect> boxes;
            mser->detectRegions(grey, regions, boxes);
            return regions.size();
        };
    if (method == "plain")
        return [o = options()](const cv::Mat& grey) {
            return saliency::test::plainScaleSaliency(grey, o).size();
        };
    saliency::TPeakLimits limits;
    limits.yMin = yMin;
    return [limits, detector = saliency::CScaleSaliency(options())](const cv::Mat& grey) {
        cv::setNumThreads(1);
        return detector.detect(grey, limits).size();
    };
}

std::vector<std::string> instructionSets() {
    std::vector<std::string> names;
    for (const auto& [name, simd] : kSets)
        if (simd == ESimd::automatic || saliency::hasSimd(simd)) names.emplace_back(name);
    return names;
}

saliency::ESimd simdNamed(const std::string& name) {
    for (const auto& [known, simd] : kSets)
        if (known == name) return simd;
    throw std::invalid_argument("no instruction set is named " + name);
}

std::string text(const cv::Size& size) {
    return std::to_string(size.width) + "x" + std::to_string(size.height);
}

}  // namespace salma::bench
