// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/slam/TViews.h>

#include <cmath>

namespace salma::slam {
namespace {

/// 181 beams from the right to the left, 5 m each but those from 10 to 20 deg to the left: 2 m.
TLaserView view() {
    TLaserView result;
    result.first = -M_PI / 2;
    result.spacing = M_PI / 180;
    auto free = std::make_shared<std::vector<float>>(181, 5.0F);
    for (int i = 100; i <= 110; ++i) (*free)[i] = 2;
    result.free = free;
    return result;
}

Eigen::Vector2d at(double range, double degrees) {
    return {range * std::cos(degrees * M_PI / 180), range * std::sin(degrees * M_PI / 180)};
}

TEST(TLaserView, TellsWhatIsHidden) {
    EXPECT_EQ(view().reaching(at(4, 0), 0.1, 0), 1);
    EXPECT_EQ(view().reaching(at(4, 15), 0.1, 0), 0);
    EXPECT_EQ(view().reaching(at(1.9, 15), 0.1, 0), 1);
    EXPECT_EQ(view().reaching(at(2.05, 15), 0.1, 0), 1);  // the beam may end a little before it
    EXPECT_EQ(view().reaching(at(6, 0), 0.1, 0), 0);
    // Of the beams from 7 to 13 deg those from 10 on are short.
    EXPECT_NEAR(view().reaching(at(4, 10), 0.1, 4 * 3.5 * M_PI / 180), 3.0 / 7, 1e-9);
}

TEST(TLaserView, KnowsNothingOfWhatLiesBehindTheScanner) {
    EXPECT_FALSE(view().looksAt(at(1, 135)));
    EXPECT_TRUE(view().looksAt(at(1, 89)));
    EXPECT_EQ(view().reaching(at(9, 135), 0.1, 0), 1);
    EXPECT_EQ(TLaserView().reaching(at(9, 0), 0.1, 0), 1);
}

TEST(TLaserView, CountsFromWhereTheScannerStandsAndLooks) {
    TLaserView turned = view();
    turned.sensor << 1, 0, M_PI / 2;
    const Eigen::Vector2d hidden = Eigen::Vector2d(1, 0) + at(4, 105);
    EXPECT_EQ(turned.reaching(hidden, 0.1, 0), 0);
    EXPECT_EQ(turned.reaching(Eigen::Vector2d(1, 0) + at(4, 90), 0.1, 0), 1);
}

}  // namespace
}  // namespace salma::slam
