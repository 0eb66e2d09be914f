// SPDX-License-Identifier: BSD-3-Clause
// Every instruction set gives the peaks of plain loops, to the last digit.
#include <gtest/gtest.h>
#include <salma/saliency/CScaleSaliency.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "CTemporaryFolder.h"
#include "plainScaleSaliency.h"

namespace salma::saliency {
namespace {

using TRegions = std::vector<observations::TSalientRegion>;

std::string asText(const observations::TSalientRegion& r) {
    std::ostringstream out;
    out.precision(17);
    out << "x " << r.x << " y " << r.y << " s " << r.s << " H " << r.H << " W " << r.W << " Y "
        << r.Y;
    return out.str();
}

::testing::AssertionResult identical(const TRegions& found, const TRegions& expected) {
    for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i)
        if (asText(found[i]) != asText(expected[i]))
            return ::testing::AssertionFailure() << "peak " << i << ": " << asText(found[i])
                                                 << " instead of " << asText(expected[i]);
    if (found.size() == expected.size()) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << found.size() << " peaks instead of " << expected.size();
}

TRegions above(const TRegions& peaks, double yMin) {
    TRegions some;
    for (const auto& peak : peaks)
        if (peak.Y >= yMin) some.push_back(peak);
    return some;
}

/// The instruction sets of this processor, the portable one among them.
std::vector<ESimd> paths() {
    std::vector<ESimd> some;
    for (const auto simd :
         {ESimd::portable, ESimd::sse4, ESimd::avx2, ESimd::avx512, ESimd::avx512dl, ESimd::neon})
        if (hasSimd(simd)) some.push_back(simd);
    return some;
}

/// Compares all peaks, and those above two thresholds, on every path.
void expectAsPlain(const cv::Mat& grey, TScaleSaliencyOptions options, const std::string& what) {
    const auto plain = test::plainScaleSaliency(grey, options);
    std::vector<double> ys{0};
    for (const auto& peak : plain) ys.push_back(peak.Y);
    std::sort(ys.begin(), ys.end());
    for (const auto simd : paths()) {
        options.simd = simd;
        const CScaleSaliency detector(options);
        for (const std::size_t rank : {std::size_t{0}, ys.size() / 2, ys.size() * 99 / 100})
            ASSERT_TRUE(identical(detector.detect(grey, {ys[rank]}), above(plain, ys[rank])))
                << what << ", simd " << static_cast<int>(simd) << ", Y >= " << ys[rank];
    }
}

/// A part of a picture small enough for plain loops, chosen by `seed`.
cv::Mat cutOut(const cv::Mat& picture, int columns, int rows, unsigned seed) {
    cv::RNG random(seed);
    const cv::Size size(std::min(columns, picture.cols), std::min(rows, picture.rows));
    const cv::Point corner(random.uniform(0, picture.cols - size.width + 1),
                           random.uniform(0, picture.rows - size.height + 1));
    return picture(cv::Rect(corner, size)).clone();
}

/// Pictures that a detector may meet, and some that it will not: one kind for each remainder.
cv::Mat synthetic(int columns, int rows, unsigned seed) {
    cv::RNG random(seed);
    cv::Mat picture(rows, columns, CV_8UC1);
    switch (seed % 8) {
        case 0:  // noise
            random.fill(picture, cv::RNG::UNIFORM, 0, 256);
            break;
        case 1:  // a slope of greys
            for (int y = 0; y < rows; ++y)
                for (int x = 0; x < columns; ++x)
                    picture.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(x + 2 * y);
            break;
        case 2:  // a chessboard: equal entropies everywhere
            for (int y = 0; y < rows; ++y)
                for (int x = 0; x < columns; ++x)
                    picture.at<std::uint8_t>(y, x) = (x / 5 + y / 5) % 2 == 0 ? 20 : 230;
            break;
        case 3:  // rectangles
            picture.setTo(120);
            for (int i = 0; i < 12; ++i)
                cv::rectangle(picture,
                              cv::Rect(random.uniform(0, columns), random.uniform(0, rows),
                                       random.uniform(2, 40), random.uniform(2, 40)),
                              cv::Scalar(random.uniform(0, 256)), cv::FILLED);
            break;
        case 4:  // text on white
            picture.setTo(255);
            for (int y = 12; y < rows; y += 14)
                cv::putText(picture, "EXIT 3.14 Room", {random.uniform(-9, 9), y},
                            cv::FONT_HERSHEY_SIMPLEX, 0.5, cv::Scalar(random.uniform(0, 90)));
            break;
        case 5:  // a single pixel
            picture.setTo(77);
            picture.at<std::uint8_t>(rows / 2, columns / 2) = 200;
            break;
        case 6:  // blurred noise
            random.fill(picture, cv::RNG::UNIFORM, 0, 256);
            cv::GaussianBlur(picture, picture, {0, 0}, 4);
            cv::normalize(picture, picture, 0, 255, cv::NORM_MINMAX);
            break;
        default:  // half of it white, half of it noise
            random.fill(picture, cv::RNG::NORMAL, 128, 30);
            picture(cv::Rect(0, 0, columns / 2, rows)).setTo(255);
    }
    return picture;
}

TEST(ScaleSaliencyPaths, GivePlainPeaksOnSyntheticPictures) {
    for (unsigned seed = 0; seed < 80; ++seed)
        expectAsPlain(synthetic(100 + static_cast<int>(seed % 7), 90, seed), {},
                      "synthetic picture " + std::to_string(seed));
}

TEST(ScaleSaliencyPaths, GivePlainPeaksOnRealPictures) {
    SALMA_NEED_DATA(corridor, "corridor_images/1.jpg");
    const auto data = std::filesystem::path(corridor).parent_path().parent_path();
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(data)) {
        const std::string kind = entry.path().extension();
        if (kind == ".jpg" || kind == ".png" || kind == ".pgm" || kind == ".ppm" || kind == ".jpeg")
            files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    unsigned pictures = 0;
    for (; pictures < 120; ++pictures) {
        const std::string& file = files[pictures * files.size() / 120];
        const cv::Mat grey = cv::imread(file, cv::IMREAD_GRAYSCALE);
        ASSERT_FALSE(grey.empty()) << file;
        expectAsPlain(cutOut(grey, 104, 92, pictures), {}, file);
    }
}

/// Settings over their whole range, mostly with few scales since plain loops are slow.
TScaleSaliencyOptions randomOptions(cv::RNG& random) {
    TScaleSaliencyOptions options;
    options.scaleMin = random.uniform(0, 20) == 0 ? random.uniform(1, 50) : random.uniform(1, 12);
    options.scaleMax = std::min(
        128, options.scaleMin + 2 +
                 (random.uniform(0, 20) == 0 ? random.uniform(0, 80) : random.uniform(0, 20)));
    options.bins = random.uniform(0, 3) == 0 ? random.uniform(2, 257) : random.uniform(8, 33);
    options.logBase = random.uniform(0, 2) == 0 ? ELogBase::two : ELogBase::natural;
    options.smooth = random.uniform(0, 3) != 0;
    options.stretch = random.uniform(0, 3) == 0;
    options.threads = random.uniform(1, 4);
    return options;
}

TEST(ScaleSaliencyPaths, GivePlainPeaksForAThousandRandomSettings) {
    cv::RNG random(2026);
    for (unsigned i = 0; i < 1000; ++i) {
        const auto options = randomOptions(random);
        const int window = 2 * options.scaleMax + 1;
        const cv::Mat grey =
            synthetic(window + random.uniform(-1, options.scaleMax > 40 ? 9 : 40),
                      window + random.uniform(-1, options.scaleMax > 40 ? 5 : 14), i);
        expectAsPlain(grey, options,
                      "setting " + std::to_string(i) + "\n" + options.asIni("saliency"));
    }
}

TEST(ScaleSaliencyPaths, FillEveryTileAndThreadAlike) {
    TScaleSaliencyOptions options;
    options.scaleMax = 12;
    options.threads = 3;
    expectAsPlain(synthetic(230, 170, 6), options, "several tiles");
}

TEST(ScaleSaliencyPaths, BoundTheFirstScaleOfManyPixelsRightly) {
    // ring(35) has 228 pixels, of which a whole number of 16-bit units is 0.8 % less than others'.
    TScaleSaliencyOptions options;
    options.scaleMin = 34;
    options.scaleMax = 40;
    cv::Mat picture(96, 96, CV_8UC1, cv::Scalar(20));
    cv::circle(picture, {48, 48}, 25, cv::Scalar(220), cv::FILLED);
    ASSERT_FALSE(test::plainScaleSaliency(picture, options).empty());
    expectAsPlain(picture, options, "disc");
}

TEST(ScaleSaliencyPaths, IncludeThePortableOne) {
    EXPECT_TRUE(hasSimd(ESimd::portable));
    EXPECT_TRUE(hasSimd(bestSimd()));
}

}  // namespace
}  // namespace salma::saliency
