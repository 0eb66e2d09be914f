// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <salma/config/TStrictOptions.h>

#include <cmath>
#include <stdexcept>

namespace salma::config {
namespace {

struct TToyOptions : public TStrictOptions<TToyOptions> {
    double low{0.1};
    double high{2};
    double angle{M_PI / 4};
    bool on{true};

    void visit(COptionVisitor& v) {
        v.number("low_m", low, atLeast(0), "lower end");
        v.number("high_m", high, atLeast(0), "upper end");
        v.degrees("angle_deg", angle, between(0, 90), "slope");
        v.flag("on", on, "used at all");
    }
    void validate() const {
        if (!(low < high)) throw std::invalid_argument("low_m must be below high_m");
    }
};

TEST(TStrictOptions, StaysUntouchedWhenOneKeyIsInvalid) {
    const mrpt::config::CConfigFileMemory file(std::string("[s]\nlow_m = 0.5\nhigh_m = -1\n"));
    TToyOptions options;
    EXPECT_THROW(options.loadFromConfigFile(file, "s"), std::invalid_argument);
    EXPECT_EQ(options.low, 0.1);
}

TEST(TStrictOptions, StaysUntouchedWhenKeysContradictEachOther) {
    const mrpt::config::CConfigFileMemory file(std::string("[s]\nlow_m = 3\n"));
    TToyOptions options;
    EXPECT_THROW(options.loadFromConfigFile(file, "s"), std::invalid_argument);
    EXPECT_EQ(options.low, 0.1);
}

TEST(TStrictOptions, ReadsBackWhatItWrites) {
    TToyOptions written;
    written.low = 0.125;
    written.on = false;
    const mrpt::config::CConfigFileMemory file(written.asIni("s"));
    TToyOptions read;
    read.loadFromConfigFile(file, "s");
    EXPECT_EQ(read.low, 0.125);
    EXPECT_NEAR(read.angle, written.angle, 1e-9);
    EXPECT_FALSE(read.on);
    EXPECT_EQ(read.asIni("s"), written.asIni("s"));
}

struct TPlainOptions : public TStrictOptions<TPlainOptions> {
    double length{1};
    int count{2};
    std::vector<double> knots{0, 1};

    void visit(COptionVisitor& v) {
        v.number("length_m", length, moreThan(0), "length");
        v.integer("count", count, between(1, 3), "how many");
        v.numbers("knots", knots, between(0, 1), "places");
    }
};

TEST(TStrictOptions, ChecksRangesOfValuesThatCameFromNoFile) {
    EXPECT_NO_THROW(TPlainOptions().validate());
    const auto problem = [](const TPlainOptions& options) -> std::string {
        try {
            options.validate();
        } catch (const std::invalid_argument& e) {
            return e.what();
        }
        return "none";
    };
    TPlainOptions options;
    options.length = 0;
    EXPECT_EQ(problem(options), "length_m = 0 is outside (0, inf)");
    options = {};
    options.count = 4;
    EXPECT_EQ(problem(options), "count = 4 is outside [1, 3]");
    options = {};
    options.knots = {0.5, std::nan("")};
    EXPECT_EQ(problem(options), "knots = nan is outside [0, 1]");
}

}  // namespace
}  // namespace salma::config
