// SPDX-License-Identifier: BSD-3-Clause
#include <CTemporaryFolder.h>
#include <gtest/gtest.h>
#include <salma/landmarks/CLandmarkDatabase.h>

#include <random>
#include <stdexcept>

namespace salma::landmarks {
namespace {

std::vector<TStoredLandmark> twoLandmarks() {
    TStoredLandmark poster;
    poster.id = 4;
    poster.kind = "salient";
    poster.mean = {1.5, -2};
    poster.covariance << 0.04, 0.01, 0.01, 0.09;
    poster.sightings = 7;
    poster.firstTime = 1000.25;
    poster.lastTime = 1234.5;
    observations::TPatch patch;
    patch.width = 0.6;
    patch.height = 0.4;
    patch.picture = mrpt::img::CImage(8, 6, mrpt::img::CH_GRAY);
    patch.picture.filledRectangle(0, 0, 7, 5, mrpt::img::TColor(90, 90, 90));
    patch.keypoints.resize(3);
    patch.keypoints[1].descriptor[127] = 200;
    poster.patch = std::make_shared<observations::TPatch>(patch);
    TStoredLandmark corner;
    corner.id = 2;
    corner.kind = "corner";
    return {poster, corner};
}

TEST(CLandmarkDatabase, ReadsBackWhatItWrote) {
    const test::CTemporaryFolder folder;
    const CLandmarkDatabase database((folder / "map.db").string());
    database.create(twoLandmarks());
    const auto read = database.read();
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read[0].id, 2) << "in order of the id";
    EXPECT_FALSE(read[0].patch);
    EXPECT_EQ(read[1].kind, "salient");
    EXPECT_EQ(read[1].mean.y, -2);
    EXPECT_EQ(read[1].covariance(1, 0), 0.01);
    EXPECT_EQ(read[1].sightings, 7);
    EXPECT_EQ(read[1].lastTime, 1234.5);
    ASSERT_TRUE(read[1].patch);
    EXPECT_EQ(read[1].patch->keypoints.at(1).descriptor[127], 200);
    EXPECT_EQ(read[1].patch->picture.getWidth(), 8u);
}

TEST(CLandmarkDatabase, WritesTheSameBytesAgain) {
    const test::CTemporaryFolder folder;
    for (const auto* name : {"a.db", "b.db"})
        CLandmarkDatabase((folder / name).string()).create(twoLandmarks());
    EXPECT_TRUE(test::readFile(folder / "a.db") == test::readFile(folder / "b.db"));
}

TEST(CLandmarkDatabase, RefusesToOverwriteAndToReadWhatIsNone) {
    const test::CTemporaryFolder folder;
    const auto text = folder.write("map.db", "not a database, but long enough to look like a file");
    EXPECT_THROW(CLandmarkDatabase(text).create({}), std::runtime_error);
    EXPECT_THROW(CLandmarkDatabase(text).read(), std::runtime_error);
    EXPECT_THROW(CLandmarkDatabase((folder / "no.db").string()).read(), std::runtime_error);
    EXPECT_THROW(CLandmarkDatabase("/no/such/folder/map.db").create({}), std::runtime_error);
}

TEST(CLandmarkDatabase, SurvivesDamagedFiles) {
    const test::CTemporaryFolder folder;
    const CLandmarkDatabase database((folder / "map.db").string());
    database.create(twoLandmarks());
    const std::string whole = test::readFile(folder / "map.db");
    std::mt19937 random(1);
    int refused = 0;
    for (int i = 0; i < 200; ++i) {
        std::string damaged = whole;
        if (i % 2 == 0) damaged.resize(random() % damaged.size());
        for (int k = 0; k < 20 && !damaged.empty(); ++k)
            damaged[random() % damaged.size()] = static_cast<char>(random());
        const std::string file = folder.write("damaged.db", damaged);
        try {
            CLandmarkDatabase(file).read();
        } catch (const std::runtime_error& e) {
            EXPECT_NE(std::string(e.what()).find("damaged.db"), std::string::npos);
            ++refused;
        }
    }
    EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace salma::landmarks
