// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/saliency/ellipseGeometry.h>

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <random>

namespace salma::saliency {
namespace {

TEllipse disc(double u, double v, double radius) {
    return {u, v, 1 / (radius * radius), 0, 1 / (radius * radius)};
}

/// Half axes along a direction at `angle` [rad] from x, and across.
TEllipse turned(double u, double v, double along, double across, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const double p = 1 / (along * along);
    const double q = 1 / (across * across);
    return {u, v, p * c * c + q * s * s, (p - q) * c * s, p * s * s + q * c * c};
}

TEllipse randomEllipse(std::mt19937& random) {
    std::uniform_real_distribution<double> place(-10, 10), axis(2, 20), angle(0, CV_PI);
    const double u = place(random);
    const double v = place(random);
    const double along = axis(random);
    const double across = axis(random);
    return turned(u, v, along, across, angle(random));
}

bool contains(const TEllipse& e, double x, double y) {
    const double dx = x - e.u;
    const double dy = y - e.v;
    return e.a * dx * dx + 2 * e.b * dx * dy + e.c * dy * dy <= 1;
}

/// Area that two discs of one radius share at this distance.
double lens(double radius, double distance) {
    return 2 * radius * radius * std::acos(distance / (2 * radius)) -
           distance / 2 * std::sqrt(4 * radius * radius - distance * distance);
}

double area(const TEllipse& e) { return CV_PI * e.radius() * e.radius(); }

TEST(ellipseGeometry, GivesTheAreaOfTheInnerOfTwoConcentricDiscs) {
    EXPECT_NEAR(intersectionArea(disc(3, 4, 5), disc(3, 4, 9)), 25 * CV_PI, 25 * CV_PI * 1e-4);
    EXPECT_NEAR(overlapError(disc(3, 4, 5), disc(3, 4, 9)), 1 - 25.0 / 81, 1e-4);
    EXPECT_NEAR(overlapError(disc(3, 4, 5), disc(3, 4, 5)), 0, 1e-4);
}

TEST(ellipseGeometry, GivesTheLensOfTwoShiftedDiscsInAnyDirection) {
    for (const double distance : {0.01, 3.0, 11.9, 30.0, 59.0, 59.99})
        for (double angle = 0; angle < 6.3; angle += 0.37)
            EXPECT_NEAR(
                intersectionArea(disc(100, 50, 30), disc(100 + distance * std::cos(angle),
                                                         50 + distance * std::sin(angle), 30)),
                lens(30, distance), 1e-4 * CV_PI * 900)
                << distance << " at " << angle;
}

TEST(ellipseGeometry, GivesNothingForDiscsThatDoNotTouch) {
    EXPECT_EQ(intersectionArea(disc(0, 0, 5), disc(10.1, 0, 5)), 0);
    EXPECT_EQ(intersectionArea(disc(0, 0, 5), disc(0, 10.1, 5)), 0);
    EXPECT_EQ(intersectionArea(disc(0, 0, 5), disc(7.2, 7.2, 5)), 0);
    EXPECT_EQ(overlapError(disc(0, 0, 5), disc(10.1, 0, 5)), 1);
}

TEST(ellipseGeometry, GivesTheRhombicOverlapOfTwoCrossedEllipses) {
    // x^2/p^2 + y^2/q^2 and its quarter turn share 4 p q atan(q/p).
    const double shared = 4 * 20 * 5 * std::atan(5.0 / 20);
    EXPECT_NEAR(intersectionArea(turned(0, 0, 20, 5, 0), turned(0, 0, 20, 5, CV_PI / 2)), shared,
                1e-4 * CV_PI * 100);
}

TEST(ellipseGeometry, DoesNotDependOnTheOrderOrAnAffineMapOfBoth) {
    std::mt19937 random(3);
    const cv::Matx33d H(1.3, 0.9, 7, -0.4, 0.8, 3, 0, 0, 1);
    for (int i = 0; i < 300; ++i) {
        const TEllipse a = randomEllipse(random);
        const TEllipse b = randomEllipse(random);
        const double error = overlapError(a, b);
        EXPECT_NEAR(overlapError(b, a), error, 1e-12);
        EXPECT_NEAR(overlapError(*mapped(H, a), *mapped(H, b)), error, 2e-4);
    }
}

TEST(ellipseGeometry, AgreesWithDartsThrownAtRandomEllipses) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> place(-32, 32);
    constexpr int kDarts = 100000;
    for (int i = 0; i < 30; ++i) {
        const TEllipse a = randomEllipse(random);
        const TEllipse b = randomEllipse(random);
        int hits = 0;
        for (int k = 0; k < kDarts; ++k) {
            const double x = place(random);
            const double y = place(random);
            hits += contains(a, x, y) && contains(b, x, y);
        }
        const double share = intersectionArea(a, b) / (64 * 64);
        const double sigma = std::sqrt(share * (1 - share) / kDarts) + 1e-5;
        EXPECT_NEAR(static_cast<double>(hits) / kDarts, share, 4 * sigma);
    }
}

TEST(ellipseGeometry, BoxesAnEllipse) {
    const cv::Size2d flat = halfBox(turned(5, 6, 8, 2, 0));
    EXPECT_NEAR(flat.width, 8, 1e-12);
    EXPECT_NEAR(flat.height, 2, 1e-12);
    const cv::Size2d slanted = halfBox(turned(5, 6, 8, 2, CV_PI / 4));
    EXPECT_NEAR(slanted.width, std::sqrt((64 + 4) / 2.0), 1e-12);
    EXPECT_NEAR(slanted.height, slanted.width, 1e-12);
}

TEST(ellipseGeometry, MapsByASimilarityExactly) {
    const double angle = 0.4;
    const double c = 1.5 * std::cos(angle);
    const double s = 1.5 * std::sin(angle);
    const cv::Matx33d H(c, -s, 10, s, c, -20, 0, 0, 1);
    const auto image = mapped(H, turned(30, 40, 8, 2, 0.1));
    ASSERT_TRUE(image);
    const auto expected = turned(c * 30 - s * 40 + 10, s * 30 + c * 40 - 20, 12, 3, 0.1 + angle);
    EXPECT_NEAR(image->u, expected.u, 1e-10);
    EXPECT_NEAR(image->v, expected.v, 1e-10);
    EXPECT_NEAR(image->a, expected.a, 1e-12);
    EXPECT_NEAR(image->b, expected.b, 1e-12);
    EXPECT_NEAR(image->c, expected.c, 1e-12);
}

TEST(ellipseGeometry, MapsASmallEllipseAsAHomographyMapsItsRim) {
    const cv::Matx33d H(0.76, -0.3, 225, 0.33, 1.01, -77, 3.5e-4, -1.4e-5, 1);
    const TEllipse e = turned(400, 300, 0.02, 0.01, 0.7);
    const auto image = mapped(H, e);
    ASSERT_TRUE(image);
    for (double t = 0; t < 6.2; t += 0.5) {
        const double along = 0.02 * std::cos(t);
        const double across = 0.01 * std::sin(t);
        const cv::Vec3d p = H * cv::Vec3d(400 + along * std::cos(0.7) - across * std::sin(0.7),
                                          300 + along * std::sin(0.7) + across * std::cos(0.7), 1);
        const double dx = p[0] / p[2] - image->u;
        const double dy = p[1] / p[2] - image->v;
        EXPECT_NEAR(image->a * dx * dx + 2 * image->b * dx * dy + image->c * dy * dy, 1, 1e-4);
    }
    const auto back = mapped(H.inv(), *image);
    ASSERT_TRUE(back);
    EXPECT_NEAR(overlapError(*back, e), 0, 1e-4);
}

TEST(ellipseGeometry, MapsNothingToInfinity) {
    const cv::Matx33d H(1, 0, 0, 0, 1, 0, 0.01, 0, 1);
    EXPECT_FALSE(mapped(H, disc(-100, 5, 3)));
    EXPECT_TRUE(mapped(H, disc(-99, 5, 3)));
    EXPECT_FALSE(mapped(cv::Matx33d(1, 2, 0, 2, 4, 0, 0, 0, 1), disc(5, 5, 3)));  // a line
}

TEST(ellipseGeometry, TellsHomographiesThatCanBeInverted) {
    EXPECT_TRUE(isInvertible(cv::Matx33d::eye()));
    EXPECT_TRUE(isInvertible(cv::Matx33d(1, 0, 5000, 0, 1, -5000, 0, 0, 1)));
    EXPECT_FALSE(isInvertible(cv::Matx33d::zeros()));
    EXPECT_FALSE(isInvertible(cv::Matx33d(1, 2, 3, 2, 4, 6, 0, 0, 1)));
    EXPECT_FALSE(isInvertible(
        cv::Matx33d(1, 0, 0, 0, std::numeric_limits<double>::quiet_NaN(), 0, 0, 0, 1)));
}

TEST(ellipseGeometry, IsExactToATenThousandthOfTheSmallerArea) {
    std::mt19937 random(5);
    for (int i = 0; i < 500; ++i) {  // an ellipse within itself enlarged
        const TEllipse inner = randomEllipse(random);
        const TEllipse outer{inner.u, inner.v, inner.a / 1.1, inner.b / 1.1, inner.c / 1.1};
        EXPECT_NEAR(intersectionArea(inner, outer), area(inner), 1e-4 * area(inner));
    }
}

}  // namespace
}  // namespace salma::saliency
