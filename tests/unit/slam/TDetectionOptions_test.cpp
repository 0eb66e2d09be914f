// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/slam/TDetectionOptions.h>

#include <cmath>
#include <stdexcept>

namespace salma::slam {
namespace {

TDetectionOptions table() {
    TDetectionOptions options;
    options.incidence = {0, 60};
    options.byIncidence = {0.8, 0.4};
    options.range = {1, 3};
    options.byRange = {1, 0.5};
    return options;
}

TEST(TDetectionOptions, MultipliesBothTables) {
    const auto at = [](double degrees, double range) {
        return table().probability(degrees * M_PI / 180, range);
    };
    EXPECT_NEAR(at(0, 1), 0.8, 1e-12);
    EXPECT_NEAR(at(30, 2), 0.6 * 0.75, 1e-12);
    EXPECT_NEAR(at(-30, 2), 0.6 * 0.75, 1e-12);
    EXPECT_NEAR(at(85, 0.1), 0.4, 1e-12);  // constant beyond the ends
    EXPECT_NEAR(at(0, 99), 0.4, 1e-12);
}

TEST(TDetectionOptions, RefusesTablesThatDoNotFit) {
    EXPECT_NO_THROW(table().validate());
    TDetectionOptions options = table();
    options.byRange = {1};
    EXPECT_THROW(options.validate(), std::invalid_argument);
    options = table();
    options.incidence = {60, 0};
    EXPECT_THROW(options.validate(), std::invalid_argument);
    options = table();
    options.byIncidence = {0.8, 1.4};
    EXPECT_THROW(options.validate(), std::invalid_argument);
    options.range = options.byRange = {};
    EXPECT_THROW(options.validate(), std::invalid_argument);
}

}  // namespace
}  // namespace salma::slam
