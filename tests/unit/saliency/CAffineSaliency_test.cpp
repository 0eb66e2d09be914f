// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/saliency/CAffineSaliency.h>
#include <salma/saliency/CGreedyClusterer.h>
#include <salma/saliency/ellipseGeometry.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace salma::saliency {
namespace {

using observations::TSalientRegion;

TSalientRegion disc(double x, double y, double s) { return {x, y, s, 1, 1, 1}; }

/// Half axes p (at the angle) and q [px].
TEllipse ellipseOfAxes(double u, double v, double p, double q, double angle) {
    const double cosine = std::cos(angle), sine = std::sin(angle);
    const double along = 1 / (p * p), across = 1 / (q * q);
    return {u, v, along * cosine * cosine + across * sine * sine, (along - across) * cosine * sine,
            along * sine * sine + across * cosine * cosine};
}

double valueAt(const TEllipse& e, double x, double y) {
    const double dx = x - e.u, dy = y - e.v;
    return e.a * dx * dx + 2 * e.b * dx * dy + e.c * dy * dy;
}

double axisRatio(const TEllipse& e) {
    const double mean = (e.a + e.c) / 2, difference = std::hypot((e.a - e.c) / 2, e.b);
    return std::sqrt((mean + difference) / (mean - difference));
}

/** An ellipse on black, 121x121, about (60, 60), whose inside repeats 8 bright levels so densely
 * that any part of it holds all of them alike. With a share f of it in a window and n levels, the
 * entropy f log n - f log f - (1-f) log(1-f) peaks at f = n / (n+1): at the window of the same
 * shape whose radii are sqrt(9/8) times as large. */
cv::Mat brightEllipse(double p, double q, double angle) {
    constexpr int kOrder[4][4] = {{0, 4, 1, 5}, {6, 2, 7, 3}, {1, 5, 0, 4}, {7, 3, 6, 2}};
    cv::Mat picture(121, 121, CV_8UC1, cv::Scalar(0));
    const TEllipse e = ellipseOfAxes(60, 60, p, q, angle);
    for (int y = 0; y < picture.rows; ++y)
        for (int x = 0; x < picture.cols; ++x)
            if (valueAt(e, x, y) <= 1)
                picture.at<std::uint8_t>(y, x) =
                    static_cast<std::uint8_t>(17 * (8 + kOrder[y % 4][x % 4]));
    return picture;
}

/// The window that brightEllipse() says.
TEllipse windowAround(double p, double q, double angle) {
    const double larger = std::sqrt(9.0 / 8);
    return ellipseOfAxes(60, 60, larger * p, larger * q, angle);
}

/// Stretches by `ratio` along the angle and shrinks by as much across; the middle stays.
cv::Matx33d stretch(double ratio, double angle, const cv::Size& size) {
    const cv::Matx22d turn(std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle));
    const cv::Matx22d m =
        turn * cv::Matx22d(std::sqrt(ratio), 0, 0, 1 / std::sqrt(ratio)) * turn.t();
    const cv::Vec2d middle(size.width / 2.0, size.height / 2.0);
    const cv::Vec2d shift = middle - m * middle;
    return {m(0, 0), m(0, 1), shift[0], m(1, 0), m(1, 1), shift[1], 0, 0, 1};
}

/// Mean overlap errors of the strongest discs and of their ellipses between a picture and its
/// stretched copy.
std::pair<double, double> errorsUnderStretch(const cv::Mat& grey, double ratio, double angle) {
    const cv::Matx33d affinity = stretch(ratio, angle, grey.size());
    cv::Mat copy;
    cv::warpPerspective(grey, copy, affinity, grey.size());
    std::vector<TSalientRegion> here, there;
    auto strongest = CGreedyClusterer().cluster(CScaleSaliency().detect(grey, {1.5})).regions;
    strongest.resize(std::min<std::size_t>(strongest.size(), 300));
    for (const auto& r : strongest) {
        const cv::Vec3d p = affinity * cv::Vec3d(r.x, r.y, 1);
        // Far enough from the border that neither copy's ellipses see it.
        if (!cv::Rect(70, 70, grey.cols - 140, grey.rows - 140).contains(cv::Point2d(p[0], p[1])))
            continue;
        here.push_back(r);
        there.push_back(disc(p[0], p[1], r.s));
    }
    EXPECT_GT(here.size(), 50u);
    const auto found = CAffineSaliency().adapt(grey, here).regions;
    const auto foundThere = CAffineSaliency().adapt(copy, there).regions;
    double ofDiscs = 0, ofEllipses = 0;
    for (std::size_t i = 0; i < here.size(); ++i) {
        ofDiscs += overlapError(*mapped(affinity, ellipseOf(here[i])), ellipseOf(there[i]));
        ofEllipses += overlapError(*mapped(affinity, found[i].ellipse), foundThere[i].ellipse);
    }
    const auto n = static_cast<double>(here.size());
    return {ofDiscs / n, ofEllipses / n};
}

// The scale is a whole number of pixels and the shape a lattice of steps 0.05: half a pixel at 15
// makes 7 % of the area, half a step of shape 2 %, pixels on the outline the rest.
TEST(CAffineSaliency, FindsAnEllipseOfKnownAxesInAnyOrientation) {
    for (const auto& [p, q] : {std::pair{20.0, 10.0}, {18.0, 12.0}, {22.0, 9.0}})
        for (int degrees = 0; degrees < 180; degrees += 15) {
            const double angle = degrees * CV_PI / 180;
            const auto found =
                CAffineSaliency().adapt(brightEllipse(p, q, angle), {disc(60, 60, 13)});
            ASSERT_EQ(found.regions.size(), 1u);
            const TEllipse& e = found.regions[0].ellipse;
            EXPECT_LT(overlapError(e, windowAround(p, q, angle)), 0.1) << p << " at " << degrees;
            EXPECT_NEAR(axisRatio(e), p / q, 0.1 * p / q) << p << " at " << degrees;
            EXPECT_EQ(found.withoutPeak + found.notConverged, 0u);
        }
}

TEST(CAffineSaliency, LeavesADiscAroundADiscAndCorrectsItsScale) {
    for (const double radius : {9.0, 12.0, 16.0, 20.0})
        for (const double scale : {0.8 * radius, 1.2 * radius}) {
            const auto found =
                CAffineSaliency().adapt(brightEllipse(radius, radius, 0), {disc(60, 60, scale)});
            const TEllipse& e = found.regions[0].ellipse;
            EXPECT_LT(axisRatio(e), 1.05) << radius;
            EXPECT_NEAR(e.radius(), std::sqrt(9.0 / 8) * radius, 0.8) << radius;
        }
}

TEST(CAffineSaliency, AgreesWithTheDetectorAboutDiscs) {
    TScaleSaliencyOptions saliency;
    saliency.scaleMin = 5;
    saliency.logBase = ELogBase::two;
    saliency.stretch = true;
    cv::Mat picture(80, 80, CV_8UC1);
    cv::RNG random(5);
    random.fill(picture, cv::RNG::UNIFORM, 40, 160);
    TAffineOptions onlyDiscs;
    onlyDiscs.maxRatio = 1;
    const auto peaks = CScaleSaliency(saliency).detect(picture);
    int compared = 0;
    for (std::size_t i = 0; i < peaks.size(); i += 7) {
        if (peaks[i].s < 12) continue;  // sampled finer than the picture
        TSalientRegion best = peaks[i];
        for (const auto& p : peaks)
            if (p.x == best.x && p.y == best.y && p.s <= std::sqrt(2) * peaks[i].s &&
                p.s >= peaks[i].s / std::sqrt(2) && p.Y > best.Y)
                best = p;
        const auto found = CAffineSaliency(onlyDiscs, saliency).adapt(picture, {peaks[i]});
        const TSalientRegion got = asDisc(found.regions[0]);
        EXPECT_NEAR(got.s, best.s, 1e-12);
        EXPECT_NEAR(got.H, best.H, 1e-12);
        EXPECT_NEAR(got.W, best.W, 1e-12);
        EXPECT_NEAR(got.Y, best.Y, 1e-12);
        ++compared;
    }
    EXPECT_GT(compared, 100);
}

TEST(CAffineSaliency, FollowsTheStretchOfAPictureWhereDiscsCannot) {
    for (const std::string name : {"GreatWave", "MonaLisa"}) {
        const cv::Mat painting =
            cv::imread(SALMA_SOURCE_DIR "/share/textures/" + name + ".jpg", cv::IMREAD_GRAYSCALE);
        ASSERT_FALSE(painting.empty());
        for (const double ratio : {2.0, 2.5}) {
            const auto [ofDiscs, ofEllipses] = errorsUnderStretch(painting, ratio, 0.7);
            std::cout << "  " << name << " stretched by " << ratio
                      << ": mean overlap error of discs " << ofDiscs << ", of ellipses "
                      << ofEllipses << "\n";
            EXPECT_LT(ofEllipses, ofDiscs);
        }
    }
}

TEST(CAffineSaliency, KeepsOrderAndCentresWhateverElseIsAsked) {
    const cv::Mat picture = brightEllipse(20, 10, 0.3);
    const auto discs = CGreedyClusterer().cluster(CScaleSaliency().detect(picture)).regions;
    const auto all = CAffineSaliency().adapt(picture, discs).regions;
    ASSERT_EQ(all.size(), discs.size());
    ASSERT_GT(discs.size(), 5u);
    for (std::size_t i = 0; i < discs.size(); ++i) {
        EXPECT_EQ(all[i].ellipse.u, discs[i].x);
        EXPECT_EQ(all[i].ellipse.v, discs[i].y);
        EXPECT_NEAR(all[i].Y, all[i].H * all[i].W, 1e-12);
        EXPECT_LE(axisRatio(all[i].ellipse), 3 + 1e-9);
        EXPECT_LE(all[i].ellipse.radius(), 2 * discs[i].s + 1e-9);
        const auto alone = CAffineSaliency().adapt(picture, {discs[i]}).regions[0];
        EXPECT_EQ(alone.ellipse.a, all[i].ellipse.a);
        EXPECT_EQ(alone.ellipse.b, all[i].ellipse.b);
        EXPECT_EQ(alone.Y, all[i].Y);
    }
}

TEST(CAffineSaliency, LeavesDiscsWhereNoEntropyPeaksOrThePictureEnds) {
    const cv::Mat flat(60, 60, CV_8UC1, cv::Scalar(7));
    auto found = CAffineSaliency().adapt(flat, {disc(30, 30, 10), disc(0, 0, 5), disc(59, 30, 3)});
    EXPECT_EQ(found.withoutPeak, 3u);
    const TEllipse& e = found.regions[1].ellipse;
    EXPECT_EQ(std::make_tuple(e.u, e.v, e.a, e.b, e.c),
              std::make_tuple(0.0, 0.0, 1 / 25.0, 0.0, 1 / 25.0));
    EXPECT_EQ(found.regions[1].Y, 1);
    found = CAffineSaliency().adapt(flat, {disc(30, 30, 1e9), disc(30, 30, 1e-9)});
    EXPECT_EQ(found.withoutPeak, 2u);
    EXPECT_TRUE(CAffineSaliency().adapt(flat, {}).regions.empty());
    EXPECT_TRUE(CAffineSaliency().adapt(cv::Mat(0, 0, CV_8UC1), {}).regions.empty());
    EXPECT_EQ(CAffineSaliency().adapt(flat(cv::Rect(0, 0, 1, 1)), {disc(0, 0, 4)}).withoutPeak, 1u);
}

TEST(CAffineSaliency, KeepsEllipsesInsideThePicture) {
    cv::Mat noise(90, 90, CV_8UC1);
    cv::RNG random(2);
    random.fill(noise, cv::RNG::UNIFORM, 0, 256);
    std::vector<TSalientRegion> discs;
    discs.reserve(200);
    for (int i = 0; i < 200; ++i)
        discs.push_back(
            disc(random.uniform(0.0, 89.0), random.uniform(0.0, 89.0), random.uniform(3.0, 30.0)));
    const auto found = CAffineSaliency().adapt(noise, discs);
    int inside = 0;
    for (std::size_t i = 0; i < discs.size(); ++i) {
        const TEllipse& e = found.regions[i].ellipse;
        if (e.b == 0 && e.a == 1 / (discs[i].s * discs[i].s)) continue;  // left as it was
        const cv::Size2d half = halfBox(e);
        EXPECT_GE(std::min(e.u - half.width, e.v - half.height), -1e-9);
        EXPECT_LE(std::max(e.u + half.width, e.v + half.height), 89 + 1e-9);
        ++inside;
    }
    EXPECT_GT(inside, 50);
}

TEST(CAffineSaliency, RefusesBadInputByName) {
    const cv::Mat flat(60, 60, CV_8UC1, cv::Scalar(7));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const TSalientRegion& bad : {disc(60, 5, 4), disc(5, -1, 4), disc(nan, 5, 4),
                                      disc(5, 5, 0), disc(5, 5, nan), disc(5, 5, 1 / 0.0)}) {
        try {
            CAffineSaliency().adapt(flat, {disc(5, 5, 4), bad});
            ADD_FAILURE() << "accepted";
        } catch (const std::invalid_argument& e) {
            EXPECT_NE(std::string(e.what()).find("disc 1 "), std::string::npos) << e.what();
        }
    }
    for (const int type : {CV_16UC1, CV_32FC1, CV_8UC3})
        EXPECT_THROW(CAffineSaliency().adapt(cv::Mat(9, 9, type), {}), std::invalid_argument);
    TAffineOptions options;
    options.maxRatio = 0.9;
    EXPECT_THROW(CAffineSaliency{options}, std::invalid_argument);
}

}  // namespace
}  // namespace salma::saliency
