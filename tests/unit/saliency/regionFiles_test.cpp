// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/saliency/regionFiles.h>

#include <random>
#include <stdexcept>

#include "CTemporaryFolder.h"

namespace salma::saliency {
namespace {

using salma::test::readFile;

const salma::test::CTemporaryFolder& folder() {
    static const salma::test::CTemporaryFolder theFolder;
    return theFolder;
}

/// What readVgg says about a file of this content; "" if it takes it.
std::string complaint(const std::string& content) {
    try {
        readVgg(folder().write("broken.vgg", content));
        return "";
    } catch (const std::runtime_error& e) {
        const std::string text = e.what();
        EXPECT_EQ(text.find((folder() / "broken.vgg").string()), 0u) << text;
        return text.substr(text.find("broken.vgg"));
    }
}

TEST(regionFiles, WriteRegionsAsTheBenchmarkReadsThem) {
    const std::string file = (folder() / "two.vgg").string();
    writeVgg(file, {ellipseOf({12, 34.5, 4, 1, 1, 1}), {1, 2, 0.5, -0.25, 0.75}});
    EXPECT_EQ(readFile(file), "1.0\n2\n12 34.5 0.0625 0 0.0625\n1 2 0.5 -0.25 0.75\n");
}

TEST(regionFiles, ReadBackWhatTheyWrote) {
    const std::string file = (folder() / "back.vgg").string();
    for (const std::size_t count : {0u, 1u, 100u}) {
        std::vector<TEllipse> regions;
        for (std::size_t i = 0; i < count; ++i) {
            const auto k = static_cast<double>(i);
            regions.push_back({k / 3, k / 7, 1 / (k + 3), 0.1 / (k + 9), 1 / (k + 5)});
        }
        writeVgg(file, regions);
        const auto back = readVgg(file);
        ASSERT_EQ(back.size(), count);
        for (std::size_t i = 0; i < count; ++i) {
            EXPECT_NEAR(back[i].u, regions[i].u, 1e-7);
            EXPECT_NEAR(back[i].b, regions[i].b, 1e-9);
            EXPECT_NEAR(back[i].c, regions[i].c, 1e-9);
        }
    }
}

TEST(regionFiles, ReadADescriptorLengthOfZeroAsNone) {
    // As VLBenchmarks writes it.
    const std::string file = folder().write("zero.vgg", "0\n1\n1 2 0.5 0.1 0.5\n");
    ASSERT_EQ(readVgg(file).size(), 1u);
    EXPECT_EQ(readVgg(file)[0].b, 0.1);
}

TEST(regionFiles, LeaveDescriptorsOut) {
    // As compute_descriptors of the benchmark writes them.
    const std::string text = "3\n2\n1 2 0.5 0.1 0.5 17 0 255\n3 4 0.5 0 0.5 1 2 3\n";
    const auto regions = readVgg(folder().write("described.vgg", text));
    ASSERT_EQ(regions.size(), 2u);
    EXPECT_EQ(regions[1].u, 3);
    EXPECT_EQ(complaint("3\n1\n1 2 0.5 0.1 0.5\n"), "broken.vgg:3: expected 8 numbers, got 5");
    EXPECT_EQ(complaint("3\n1\n1 2 0.5 0.1 0.5 1 2 x\n"),
              "broken.vgg:3: 'x' is not a finite number");
}

TEST(regionFiles, RefuseMoreRegionsThanAreWanted) {
    const std::string file = folder().write("two.vgg", "1.0\n2\n1 2 1 0 1\n1 2 1 0 1\n");
    EXPECT_EQ(readVgg(file, 2).size(), 2u);
    EXPECT_THROW(readVgg(file, 1), std::runtime_error);
}

TEST(regionFiles, NameFileLineAndMistake) {
    EXPECT_EQ(complaint(""), "broken.vgg:0: file ends before the descriptor length 1.0");
    for (const std::string length : {"-1", "1.5", "1001"})
        EXPECT_EQ(complaint(length + "\n0\n"),
                  "broken.vgg:1: descriptor length is not a whole number from 0 to 1000");
    EXPECT_EQ(complaint("1.0\n"), "broken.vgg:1: file ends before the number of regions");
    EXPECT_EQ(complaint("1.0\n-1\n"),
              "broken.vgg:2: number of regions is not a whole number from 0 to 1000000000");
    EXPECT_EQ(complaint("1.0\n1\n1 2 3 0 x3\n"), "broken.vgg:3: 'x3' is not a finite number");
    EXPECT_EQ(complaint("1.0\n1\n1 nan 3 0 3\n"), "broken.vgg:3: 'nan' is not a finite number");
    EXPECT_EQ(complaint("1.0\n1\n1 2 3 0\n"), "broken.vgg:3: expected 5 numbers, got 4");
    EXPECT_EQ(complaint("1.0\n1\n1 2 1 2 1\n"), "broken.vgg:3: a, b, c are not an ellipse");
    EXPECT_EQ(complaint("1.0\n2\n1 2 1 0 1\n"), "broken.vgg:3: file ends after 1 of 2 regions");
    EXPECT_EQ(complaint("1.0\n0\n1 2 1 0 1\n"), "broken.vgg:3: more regions than the 0 announced");
    EXPECT_THROW(readVgg((folder() / "missing.vgg").string()), std::runtime_error);
}

TEST(regionFiles, EitherReadOrNameTheLineOfAnyBrokenFile) {
    const std::string whole = "1.0\n3\n1 2 0.5 0.1 0.5\n3 4 1e-2 0 1e-2\n5.5 6 2 -1 2\n";
    std::mt19937 random(11);
    for (int i = 0; i < 500; ++i) {
        std::string text = whole.substr(0, i % 3 == 0 ? random() % whole.size() : whole.size());
        for (std::size_t k = 0; k < 1 + random() % 4 && !text.empty(); ++k)
            text[random() % text.size()] = static_cast<char>(random() % 256);
        std::size_t line = 0;
        const std::string said = complaint(text);
        if (said.empty()) continue;
        ASSERT_EQ(std::sscanf(said.c_str(), "broken.vgg:%zu: ", &line), 1) << said;
    }
}

/// What readHomography says about a file of this content; "" if it takes it.
std::string matrixComplaint(const std::string& content) {
    try {
        readHomography(folder().write("H1to2p", content));
        return "";
    } catch (const std::runtime_error& e) {
        const std::string text = e.what();
        EXPECT_EQ(text.find((folder() / "H1to2p").string()), 0u) << text;
        return text.substr(text.find("H1to2p"));
    }
}

constexpr auto kMatrix =
    "   8.7976964e-01   3.1245438e-01  -3.9430589e+01\n"
    "  -1.8389418e-01   9.3847198e-01   1.5315784e+02\n"
    "   1.9641425e-04  -1.6015275e-05   1.0000000e+00\n";

TEST(regionFiles, ReadAHomographyByRows) {
    const auto H = readHomography(folder().write("H1to2p", kMatrix));
    EXPECT_EQ(H(0, 1), 0.31245438);
    EXPECT_EQ(H(1, 2), 153.15784);
    EXPECT_EQ(H(2, 0), 1.9641425e-04);
    EXPECT_EQ(matrixComplaint(std::string(kMatrix) + "\n  \r\n"), "");
}

TEST(regionFiles, NameWhatIsWrongWithAHomography) {
    EXPECT_EQ(matrixComplaint(""), "H1to2p:0: file ends after 0 of 3 rows");
    EXPECT_EQ(matrixComplaint("1 0 0\n0 1 0\n"), "H1to2p:2: file ends after 2 of 3 rows");
    EXPECT_EQ(matrixComplaint("1 0 0\n0 1\n0 0 1\n"), "H1to2p:2: expected 3 numbers, got 2");
    EXPECT_EQ(matrixComplaint("1 0 0\n0 nan 0\n0 0 1\n"), "H1to2p:2: 'nan' is not a finite number");
    EXPECT_EQ(matrixComplaint("1 0 0\n0 1 0\n0 0 1e999\n"),
              "H1to2p:3: '1e999' is not a finite number");
    EXPECT_EQ(matrixComplaint("1 2 3\n2 4 6\n0 0 1\n"),
              "H1to2p:3: the matrix that ends here is singular");
    EXPECT_EQ(matrixComplaint(std::string(kMatrix) + "1 2 3\n"), "H1to2p:4: more than 3 rows");
    EXPECT_THROW(readHomography((folder() / "missing").string()), std::runtime_error);
}

TEST(regionFiles, EitherReadOrNameTheLineOfAnyBrokenHomography) {
    const std::string whole = kMatrix;
    std::mt19937 random(12);
    int refused = 0;
    for (int i = 0; i < 1000; ++i) {
        std::string text = whole.substr(0, i % 3 == 0 ? random() % whole.size() : whole.size());
        for (std::size_t k = 0; k < 1 + random() % 4 && !text.empty(); ++k)
            text[random() % text.size()] = static_cast<char>(random() % 256);
        std::size_t line = 0;
        const std::string said = matrixComplaint(text);
        if (said.empty()) continue;
        ++refused;
        ASSERT_EQ(std::sscanf(said.c_str(), "H1to2p:%zu: ", &line), 1) << said;
    }
    EXPECT_GT(refused, 500);
}

TEST(regionFiles, WriteTablesWithUnitsInTheirColumns) {
    const std::string file = (folder() / "table.csv").string();
    writeRegionsCsv(file, std::vector<observations::TSalientRegion>{{10, 20, 5, 2.5, 0.75, 1.875}});
    EXPECT_EQ(readFile(file),
              "x_px,y_px,scale_px,entropy,interscale,saliency\n10,20,5,2.5,0.75,1.875\n");
    TStableRegion stable;
    stable.ellipse = {10, 20, 0.25, 0, 0.25};
    stable.pixels.resize(13);
    stable.meanGrey = 40.5;
    writeRegionsCsv(file, std::vector<TStableRegion>{stable});
    EXPECT_EQ(readFile(file),
              "x_px,y_px,scale_px,entropy,interscale,saliency,area_px2,mean_grey,polarity\n"
              "10,20,2,,,,13,40.5,dark\n");
}

TEST(regionFiles, SayWhereTheyCannotWrite) {
    const std::string file = (folder() / "no/such/folder.vgg").string();
    EXPECT_THROW(writeVgg(file, {}), std::runtime_error);
    EXPECT_THROW(writeRegionsCsv(file, std::vector<TStableRegion>()), std::runtime_error);
}

}  // namespace
}  // namespace salma::saliency
