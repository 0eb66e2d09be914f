// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>

#include "room.h"

namespace salma::simulator {
namespace {

using test::CTemporaryFolder;

std::string errorOf(const std::string& ini) {
    const CTemporaryFolder folder;
    folder.write("notes.txt", "no picture");
    try {
        load(folder, ini);
    } catch (const std::invalid_argument& e) {
        return e.what();
    }
    return "(accepted)";
}

void expectError(const std::string& more, const std::string& part) {
    const std::string error = errorOf(roomIni(more));
    EXPECT_NE(error.find(part), std::string::npos) << error;
    EXPECT_NE(error.find("room.ini"), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
}

const std::string kPoster = "[poster_p]\nwall = east\nwidth_m = 0.6\nheight_m = 0.6\n";
const std::string kDoor = "[door_d]\nwall = north\nat_m = 2\n";

TEST(LoadWorld, TakesWhatTheFileSaysAndDefaultsForTheRest) {
    const CTemporaryFolder folder;
    const TWorld world = load(folder, markerIni() + "[laser]\nmode = cm\n" + kDoor);
    EXPECT_EQ(world.name(), "room");
    ASSERT_EQ(world.walls.size(), 4u);
    EXPECT_DOUBLE_EQ(world.wall("south").length(), 6);
    EXPECT_EQ(world.laser.mode, ELaserMode::cm);
    EXPECT_EQ(world.laser.beams(), 361u);
    EXPECT_EQ(world.camera.columns(), 768);
    ASSERT_EQ(world.posters.size(), 1u);
    EXPECT_EQ(world.posters[0].texture, "marker");
    EXPECT_DOUBLE_EQ(world.doors.at(0).width, 0.9);
}

TEST(LoadWorld, NamesTheElementThatIsWrong) {
    expectError("[sofa]\nx = 1\n", "unknown sections: [sofa]");
    expectError("[wall_a]\nfrom_m = 0 0\nto_m = 0 1\ncolour = red\n",
                "[wall_a] has unknown keys: colour");
    expectError("[wall_a]\nfrom_m = 1 1\nto_m = 1 1\n",
                "[wall_a] to_m = '1 1' leaves the wall without length");
    expectError("[wall_a]\nfrom_m = 1 1 2\nto_m = 1 1\n",
                "[wall_a] from_m = '1 1 2' must be two numbers");
    expectError("[wall_a]\nfrom_m = 1 nan\nto_m = 1 1\n", "[wall_a] from_m");
    expectError("[laser]\naperture_deg = 120\n", "[laser] aperture_deg = '120' is not one of");
    expectError("[head]\nmode = fixed:200\n", "[head] mode = 'fixed:200'");
    expectError("[box_b]\ncentre_m = 0 0\nbottom_m = 1\ntop_m = 0.5\n", "[box_b] bottom_m = 1");
}

TEST(LoadWorld, RefusesTexturesThatDoNotExistOrAreNoPicture) {
    expectError(kPoster + "at_m = 1\ntexture = gone.jpg\n",
                "[poster_p] texture = 'gone.jpg' is neither");
    expectError(kPoster + "at_m = 1\ntexture = notes.txt\n",
                "[poster_p] texture = 'notes.txt' is not a picture");
    expectError(kPoster + "at_m = 1\n", "[poster_p] texture = '' names no texture");
    expectError("[world]\nfloor = lava\n", "[world] floor = 'lava'");
}

TEST(LoadWorld, KeepsDoorsAndPostersOnTheirWalls) {
    expectError(kPoster + "at_m = 2.8\ntexture = brick\n",
                "[poster_p] at_m = '2.8' puts the poster outside");
    expectError(kPoster + "at_m = 1\ncentre_height_m = 2.5\ntexture = brick\n",
                "[poster_p] centre_height_m");
    expectError("[poster_p]\nwall = moon\ntexture = brick\n",
                "[poster_p] wall = 'moon' is not the name");
    expectError("[door_d]\nwall = north\nat_m = 5.8\n",
                "[door_d] at_m = '5.8' puts a door outside");
    expectError("[door_d]\nwall = north\nat_m = 2 2.5\n",
                "[door_d] at_m = '2 2.5' overlaps itself");
    expectError(kDoor + "[door_e]\nwall = north\nat_m = 2.4\n", "overlaps [door_");
    expectError("[door_d]\nwall = north\nat_m = 2\nheight_m = 3\n",
                "[door_d] height_m = '3' reaches");
    expectError(kDoor + "[poster_p]\nwall = north\nat_m = 2.5\ntexture = brick\n",
                "hangs over [door_d]");
}

TEST(LoadWorld, RefusesAPathThatCannotBeDriven) {
    const auto withPath = [](const std::string& path) {
        return errorOf("[path]\n" + path + "[wall_a]\nfrom_m = 0 5\nto_m = 1 5\n");
    };
    EXPECT_NE(withPath("points_m = 0 0 1\n").find("an x lacks its y"), std::string::npos);
    EXPECT_NE(withPath("points_m = 0 0 1 0\n").find("too few points"), std::string::npos);
    EXPECT_NE(withPath("points_m = 0 0 1 0 1 1 0 1\n").find("[path] points_m"), std::string::npos);
    EXPECT_NE(withPath("points_m = 0 0 5 0\nclosed = false\nlaps = 2\n").find("laps = 2"),
              std::string::npos);
}

TEST(LoadWorld, ReadsBackWhatAsIniWrites) {
    const CTemporaryFolder folder;
    const TWorld world =
        load(folder, markerIni() + kDoor + "[box_b]\ncentre_m = 1 1\nyaw_deg = 30\n");
    const TWorld again = load(folder, asIni(world));
    EXPECT_EQ(asIni(again), asIni(world));
}

TEST(LoadWorld, TakesEveryShippedWorld) {
    for (const std::string name :
         {"hallway-loop", "corridor-20x3", "blank", "calibration-learn", "calibration-report"}) {
        const TWorld world =
            loadWorld(std::string(SALMA_SOURCE_DIR) + "/share/worlds/" + name + ".ini");
        EXPECT_EQ(world.posters.size(), name == "blank" ? 0u : name == "hallway-loop" ? 14u : 8u);
        EXPECT_EQ(world.path.laps, name.rfind("calibration", 0) == 0 ? 3 : 2);
    }
}

TEST(LoadWorld, EndsInAWorldOrAnErrorForAnyDamagedFile) {
    const CTemporaryFolder folder;
    const std::string whole = markerIni() + kDoor + "[box_b]\ncentre_m = 1 1\n";
    std::mt19937 random(1);
    int refused = 0;
    for (int i = 0; i < 300; ++i) {
        std::string text = whole;
        if (i % 3 == 0) text.resize(random() % text.size());
        for (int k = 0; k < 3 && !text.empty(); ++k)
            text[random() % text.size()] = static_cast<char>(random() % 256);
        try {
            load(folder, text);
        } catch (const std::invalid_argument& e) {
            ++refused;
            EXPECT_NE(std::string(e.what()), "");
        }
    }
    EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace salma::simulator
