// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <salma/drivers/TViscaOptions.h>

#include <cmath>

using mrpt::DEG2RAD;
using salma::drivers::TViscaOptions;

namespace {

std::string messageOf(const std::string& ini) {
    try {
        TViscaOptions().loadFromConfigFile(mrpt::config::CConfigFileMemory("[c]\n" + ini), "c");
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST(TViscaOptions, ReadsBackWhatItWrites) {
    TViscaOptions options;
    options.panCounts = -8.61;
    options.tiltMin = DEG2RAD(-20.0);
    TViscaOptions loaded;
    loaded.loadFromConfigFile(mrpt::config::CConfigFileMemory(options.asIni("c")), "c");
    EXPECT_EQ(loaded.asIni("c"), options.asIni("c"));
    EXPECT_DOUBLE_EQ(loaded.panCounts, -8.61);
}

TEST(TViscaOptions, NamesWhatIsWrong) {
    EXPECT_NE(messageOf("address = 8\n").find("[c] address = '8'"), std::string::npos);
    EXPECT_NE(messageOf("adress = 1\n").find("unknown keys: adress"), std::string::npos);
    EXPECT_NE(messageOf("pan_min_deg = 90\npan_max_deg = 10\n").find("pan_min_deg"),
              std::string::npos);
    EXPECT_NE(messageOf("tilt_counts_per_deg = 0\n").find("tilt_counts_per_deg"),
              std::string::npos);
    EXPECT_NE(messageOf("pan_counts_per_deg = 500\n").find("16 bits"), std::string::npos);
    EXPECT_NE(messageOf("field_tele_deg = 60\n").find("field_tele_deg"), std::string::npos);
    EXPECT_EQ(messageOf("baud = 9600\n"), "");
}

TEST(TZoomModel, EndsAreThoseOfTheDataSheet) {
    const auto lens = TViscaOptions().zoom;
    EXPECT_DOUBLE_EQ(lens.factor(0), 1);
    EXPECT_NEAR(lens.field(lens.factor(0)), DEG2RAD(48.8), 1e-12);
    EXPECT_NEAR(lens.field(lens.factor(1023)), DEG2RAD(4.4), 1e-12);
    EXPECT_NEAR(lens.maxFactor(), 11.81, 0.01);  // tan(24.4 deg) / tan(2.2 deg)
    EXPECT_DOUBLE_EQ(lens.factor(-5), 1);
    EXPECT_DOUBLE_EQ(lens.factor(5000), lens.maxFactor());
}

TEST(TZoomModel, HalfOfTheWayIsTheMiddleFocalLengthOfThree) {
    const auto lens = TViscaOptions().zoom;
    EXPECT_NEAR(lens.factor(511) * lens.factor(512), lens.maxFactor(), 1e-9);
}

TEST(TZoomModel, CountsAndFactorsAreInverse) {
    const auto lens = TViscaOptions().zoom;
    for (int counts = 0; counts <= 1023; ++counts)
        ASSERT_EQ(lens.counts(lens.factor(counts)), counts);
    double last = 10;
    for (int counts = 0; counts <= 1023; ++counts) {
        const double field = lens.field(lens.factor(counts));
        ASSERT_LT(field, last);
        last = field;
    }
}

TEST(TZoomModel, PassesThroughWhatWasMeasured) {
    auto lens = TViscaOptions().zoom;
    lens.tableDegrees = {400, 25, 800, 9};
    EXPECT_NO_THROW(lens.validate());
    EXPECT_NEAR(lens.field(lens.factor(0)), DEG2RAD(48.8), 1e-12);
    EXPECT_NEAR(lens.field(lens.factor(400)), DEG2RAD(25.0), 1e-12);
    EXPECT_NEAR(lens.field(lens.factor(800)), DEG2RAD(9.0), 1e-12);
    EXPECT_NEAR(lens.field(lens.maxFactor()), DEG2RAD(4.4), 1e-12);
    EXPECT_NEAR(std::pow(lens.factor(600), 2), lens.factor(400) * lens.factor(800), 1e-9);
    for (int counts = 0; counts <= 1023; ++counts)
        ASSERT_EQ(lens.counts(lens.factor(counts)), counts);
}

TEST(TZoomModel, ATableThatDoesNotFallIsRefused) {
    const auto isGood = [](const std::vector<double>& table) {
        auto lens = TViscaOptions().zoom;
        lens.tableDegrees = table;
        try {
            lens.validate();
        } catch (const std::invalid_argument&) {
            return false;
        }
        return true;
    };
    EXPECT_TRUE(isGood({}));
    EXPECT_TRUE(isGood({400, 25}));
    EXPECT_FALSE(isGood({400}));
    EXPECT_FALSE(isGood({0, 25}));
    EXPECT_FALSE(isGood({1023, 25}));
    EXPECT_FALSE(isGood({400, 25, 300, 20}));
    EXPECT_FALSE(isGood({400, 25, 500, 26}));
    EXPECT_FALSE(isGood({400, 60}));
    EXPECT_FALSE(isGood({400, 4}));
    EXPECT_FALSE(isGood({400, 0}));
    EXPECT_FALSE(isGood({400, 200}));
    EXPECT_NE(messageOf("field_table_deg = 400 60\n").find("field_table_deg"), std::string::npos);
}
