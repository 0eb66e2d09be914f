// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationImage.h>
#include <salma/simulator/CSimulator.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <set>

#include "room.h"

namespace salma::simulator {
namespace {

using Eigen::Vector3d;
using test::CTemporaryFolder;

/// A hall of 10 m x 8 m with a poster in the middle of each long wall; three laps round in it.
std::string hall(const std::string& more = {}) {
    return "[path]\npoints_m = 0 0 6 0 6 4 0 4\nlaps = 3\nspeed_mps = 1\nturn_rate_deg_s = 90\n"
           "[head]\nmode = fixed:0\nperiod_s = 2\n"
           "[wall_south]\nfrom_m = 8 -2\nto_m = -2 -2\n[wall_east]\nfrom_m = 8 6\nto_m = 8 -2\n"
           "[wall_north]\nfrom_m = -2 6\nto_m = 8 6\n[wall_west]\nfrom_m = -2 -2\nto_m = -2 6\n"
           "[poster_p]\nwall = east\nat_m = 6\nwidth_m = 0.6\nheight_m = 0.6\ntexture = notice\n" +
           more;
}

std::string errorOf(const std::string& ini) {
    const CTemporaryFolder folder;
    try {
        load(folder, ini);
    } catch (const std::invalid_argument& e) {
        return e.what();
    }
    return "";
}

TEST(People, TheLaserSeesThemAndTheyHideWhatIsBehind) {
    const CTemporaryFolder folder;
    TWorld world = load(folder, hall());
    world.laser.noise = 0;
    const CSimulator empty(world, {1, 1});
    world.people.count = 6;
    const CSimulator full(world, {1, 1});
    std::size_t nearer = 0, farther = 0;
    for (std::size_t i = 0; i < empty.scanTimes().size(); i += 5) {
        const auto a = empty.scan(i), b = full.scan(i);
        for (std::size_t k = 0; k < a.getScanSize(); ++k) {
            if (!a.getScanRangeValidity(k)) continue;  // beyond the laser's reach
            nearer += b.getScanRange(k) < a.getScanRange(k) - 0.3F ? 1 : 0;
            farther += b.getScanRange(k) > a.getScanRange(k) + 0.3F ? 1 : 0;
        }
    }
    EXPECT_GT(nearer, 100u);
    EXPECT_EQ(farther, 0u);
}

TEST(People, ThePictureShowsWhoHidesAPosterAndTheTruthSaysSo) {
    const CTemporaryFolder folder;
    TWorld world = load(folder, hall());
    const CSimulator empty(world, {1, 1});
    world.people.count = 12;
    world.people.aside = 0.8;
    const CSimulator full(world, {1, 1});
    std::size_t hidden = 0;
    for (std::size_t i = 0; i < empty.pictureCount(); ++i) {
        if (empty.sightingsInPicture(i).size() == full.sightingsInPicture(i).size()) continue;
        if (hidden++ > 0) continue;  // one rendering will do
        EXPECT_GT(cv::norm(empty.picture(i), full.picture(i), cv::NORM_INF), 60);
    }
    EXPECT_GT(hidden, 0u);
}

TEST(People, KeepAwayFromTheRobotAndAreOthersInEachRun) {
    const CTemporaryFolder folder;
    TWorld world = load(folder, hall("[people]\ncount = 20\naside_m = 0.3\n"));
    const CPath path(world.path);
    const CPeople people(world.people, path, 1), same(world.people, path, 1),
        other(world.people, path, 2);
    std::size_t met = 0;
    for (double time = 0; time < path.duration(); time += 0.3) {
        const auto robot = path.pose(time);
        const auto around = people.around(time);
        for (std::size_t i = 0; i < around.size(); ++i) {
            ++met;
            EXPECT_GT(std::hypot(around[i].place.x - robot.x, around[i].place.y - robot.y), 0.5);
            EXPECT_EQ(around[i].place.x, same.around(time)[i].place.x);
        }
    }
    EXPECT_GT(met, 100u);
    EXPECT_NE(people.around(1).front().place.x, other.around(1).front().place.x);
}

TEST(Scenes, ADoorIsOpenInItsLapsOnly) {
    const CTemporaryFolder folder;
    const TWorld world =
        load(folder, hall("[door_d]\nwall = north\nat_m = 5\nopen_laps = 2\ncloset_m = 1.5\n"));
    const CScenes scenes(world);
    const Vector3d from(3.2, 4, 0.4);
    const auto depth = [&](int lap) { return scenes.at(lap, 1).distanceTo(from, {0, 1, 0}) - 2; };
    EXPECT_NEAR(depth(1), 0.12, 1e-9);
    EXPECT_NEAR(depth(2), 1.5, 1e-9);
    EXPECT_NEAR(depth(3), 0.12, 1e-9);
    // the corners at the door's front are the same landmarks in all laps
    std::set<int> ids[2];
    for (const int lap : {1, 2})
        for (const auto& l : scenes.at(lap, 1).landmarks())
            if (l.kind == ETruthKind::corner && std::abs(l.centre.y() - 6) < 1e-6)
                ids[lap - 1].insert(l.id);
    EXPECT_GE(ids[0].size(), 4u);
    EXPECT_EQ(ids[0], ids[1]);
    std::set<int> all;
    for (const auto& l : scenes.landmarks()) EXPECT_TRUE(all.insert(l.id).second) << l.id;
    EXPECT_EQ(*all.rbegin(), static_cast<int>(all.size()));
}

TEST(Scenes, AMovedPosterHasTwoPlacesAndIsSeenAtTheSecondFromItsLapOn) {
    const CTemporaryFolder folder;
    const TWorld world = load(folder, hall("[poster_q]\nwall = north\nat_m = 2\nwidth_m = 0.5\n"
                                           "height_m = 0.5\ntexture = exit\nmoved_in_lap = 2\n"
                                           "moved_at_m = 7\n"));
    const CSimulator drive(world, {1, 1});
    const auto& landmarks = drive.landmarks();
    ASSERT_GE(landmarks.size(), 3u);
    EXPECT_NEAR(landmarks[1].centre.x(), 0, 1e-9);  // -2 + 2
    EXPECT_NEAR(landmarks[2].centre.x(), 5, 1e-9);  // -2 + 7
    std::map<int, std::set<int>> lapsOf;
    for (std::size_t i = 0; i < drive.pictureCount(); ++i)
        for (const auto& s : drive.sightingsInPicture(i))
            lapsOf[s.landmark].insert(drive.worldAt(drive.pictureTime(i)).landmarks()[1].id);
    EXPECT_EQ(lapsOf[2], std::set<int>{2});
    EXPECT_EQ(lapsOf[3], std::set<int>{3});
    EXPECT_EQ(lapsOf[1].size(), 2u);
}

TEST(Scenes, OnlyTheRobotsOwnFloorIsSeen) {
    const CTemporaryFolder folder;
    TWorld world = load(folder, hall("[wall_across]\nfrom_m = 3 6\nto_m = 3 -2\nfloor = 2\n"
                                     "[box_b]\ncentre_m = 1 5\nfloor = 2\n"));
    world.path.floors = {1, 2, 2, 1};
    const CScenes scenes(world);
    EXPECT_GT(scenes.at(1, 1).distanceTo({0, 0, 1}, {1, 0, 0}), 7.9);
    EXPECT_NEAR(scenes.at(1, 2).distanceTo({0, 0, 1}, {1, 0, 0}), 3, 1e-9);
    const CPath path(world.path);
    std::set<int> floors;
    for (double time = 0; time < path.duration(); time += 0.1) {
        floors.insert(path.floor(time));
        const auto pose = path.pose(time);
        if (!(pose.x > 1.5 && pose.x < 4.5)) continue;  // not in the corners
        EXPECT_EQ(path.floor(time), pose.y < 2 ? 1 : 2) << time;
    }
    EXPECT_EQ(floors, (std::set<int>{1, 2}));
    EXPECT_EQ(path.lap(0), 1);
    EXPECT_EQ(path.lap(path.firstLapEnd() + 0.1), 2);
    EXPECT_EQ(path.lap(path.duration()), 3);
}

TEST(Glare, GlassMirrorsALampWhereTheAnglesAreEqual) {
    const CTemporaryFolder folder;
    // camera and lamp at one height, 3 m and 3 m from the east wall: the glare is half way between
    const std::string lamp = "[lamp_l]\nposition_m = 5 1.9 1.35\nbrightness = 2\nwidth_deg = 3\n";
    const auto render = [&](const std::string& gloss, const std::string& lamps) {
        const TWorld world =
            load(folder, hall("[poster_g]\nwall = east\nat_m = 4.5\nwidth_m = 1.6\nheight_m = 1\n"
                              "border_m = 0\ncentre_height_m = 1.35\ntexture = plain\n" +
                              gloss + lamps));
        const CWorld scene(world);
        const CCameraModel camera(world.camera);
        const mrpt::poses::CPose3D T_w_c(5, 1.1, 1.35, -M_PI / 2, 0, -M_PI / 2);
        return std::pair(CRenderer(scene, camera).render(T_w_c).colour,
                         camera.distort({-(1.5 - 1.1) / 3, 0}));
    };
    const auto [matt, at] = render("", lamp);
    const auto [glossy, same] = render("gloss = 0.5\n", lamp);
    const auto [dark, again] = render("gloss = 0.5\n", "");
    const int row = static_cast<int>(std::lround(at.y())), column = int(std::lround(at.x()));
    EXPECT_NEAR(glossy(row, column)[0] - matt(row, column)[0], 255, 5);  // 0.5 of 2 white
    EXPECT_NEAR(glossy(row, column + 150)[0], matt(row, column + 150)[0], 2);
    EXPECT_EQ(cv::norm(matt, dark), 0);
}

TEST(Disturbances, SlipsAreAStreamOfTheirOwn) {
    const CTemporaryFolder folder;
    TWorld world = load(folder, hall());
    world.odometry.slip = world.odometry.slipTurn = 0;
    const auto drive = [&](double slipsPerMetre, double slip) {
        TOdometryOptions options = world.odometry;
        options.slipsPerMetre = slipsPerMetre;
        options.slip = slip;
        COdometryModel model(options, 1);
        mrpt::math::TPose2D pose;
        for (double x = 0; x < 50; x += 0.025) pose = model.next({x, 0, 0});
        return pose.x;
    };
    EXPECT_EQ(drive(0.2, 0), drive(0, 0));
    EXPECT_GT(std::abs(drive(0.2, 0.3) - drive(0, 0)), 0.05);
}

TEST(Disturbances, ASilentLaserLeavesGapsAndTheOtherTimesAsTheyWere) {
    const CTemporaryFolder folder;
    TWorld world = load(folder, hall());
    const CSimulator steady(world, {1, 1});
    world.laser.silentEvery = 10;
    world.laser.silent = 4;
    const CSimulator gaps(world, {1, 1});
    const auto &all = steady.scanTimes(), &some = gaps.scanTimes();
    EXPECT_TRUE(std::includes(all.begin(), all.end(), some.begin(), some.end()));
    EXPECT_LT(some.size(), all.size());
    double longest = 0;
    for (std::size_t i = 1; i < some.size(); ++i)
        longest = std::max(longest, some[i] - some[i - 1]);
    EXPECT_GT(longest, 3.9);
}

TEST(Disturbances, TheLaserMayStateLessNoiseThanItHas) {
    const CTemporaryFolder folder;
    TWorld world = load(folder, hall());
    world.laser.noise = 0.02;
    const float honest = CSimulator(world, {1, 1}).scan(0).stdError;
    world.laser.statedNoise = 0.005;
    const CSimulator drive(world, {1, 1});
    EXPECT_GT(honest, 0.0199F);
    EXPECT_LT(drive.scan(0).stdError, 0.0051F);
    EXPECT_EQ(drive.scan(0).getScanRange(7), CSimulator(world, {1, 1}).scan(0).getScanRange(7));
}

TEST(Disturbances, LatencyThatVariesMovesStampsOnly) {
    const CTemporaryFolder folder;
    TWorld world = load(folder, hall());
    const CSimulator steady(world, {1, 1});
    world.camera.latencyJitter = 0.03;
    const CSimulator varies(world, {1, 1});
    std::set<long> shifts;
    for (std::size_t i = 0; i < steady.pictureCount(); ++i) {
        EXPECT_EQ(steady.pictureTime(i), varies.pictureTime(i));
        const auto a = steady.sightingsInPicture(i), b = varies.sightingsInPicture(i);
        ASSERT_EQ(a.size(), b.size());
        if (!a.empty()) shifts.insert(std::lround((b[0].stamp - a[0].stamp) * 1e6));
    }
    EXPECT_GT(shifts.size(), 2u);
}

TEST(HardWorlds, MistakesAreNamed) {
    EXPECT_EQ(errorOf(hall()), "");
    EXPECT_NE(errorOf(hall("[people]\ncuont = 1\n")).find("cuont"), std::string::npos);
    EXPECT_NE(errorOf(hall("[lamp_l]\nposition_m = 1 2\n")).find("[lamp_l] position_m"),
              std::string::npos);
    EXPECT_NE(errorOf(hall("[door_d]\nwall = north\nat_m = 5\nopen_laps = 1.5\n"))
                  .find("open_laps = 1.5"),
              std::string::npos);
    const std::string moved =
        "[poster_q]\nwall = north\nat_m = 2\ntexture = exit\nmoved_in_lap = 2\n";
    EXPECT_NE(errorOf(hall(moved + "moved_at_m = 9.9\n")).find("[poster_q] moved_at_m"),
              std::string::npos);
    EXPECT_NE(errorOf(hall(moved + "moved_at_m = 5\n[door_d]\nwall = north\nat_m = 5\n"))
                  .find("moved_at_m"),
              std::string::npos);
    std::string floors = hall();
    floors.insert(floors.find("laps"), "floors = 1 2\n");
    EXPECT_NE(errorOf(floors).find("floors holds 2 numbers"), std::string::npos);
}

/// Share of the posters that show what another shows too.
double repeatShare(const TWorld& world) {
    std::map<std::string, int> times;
    for (const auto& p : world.posters) ++times[p.texture];
    const auto repeated = std::count_if(world.posters.begin(), world.posters.end(),
                                        [&](const auto& p) { return times[p.texture] > 1; });
    return static_cast<double>(repeated) / static_cast<double>(world.posters.size());
}

TEST(HardWorlds, AreHardInTheWaysThatTheyMustBe) {
    for (const char* name : {"aliased", "figure-eight", "floors"}) {
        SCOPED_TRACE(name);
        const TWorld world =
            loadWorld(std::string(SALMA_SOURCE_DIR) + "/share/worlds/" + name + ".ini");
        EXPECT_GE(repeatShare(world), 0.6);
        EXPECT_LT(repeatShare(world), 0.8);  // enough is left for a good method
        EXPECT_GE(world.path.laps, 2);
        EXPECT_GT(world.people.count, 0);
        EXPECT_FALSE(world.lamps.empty());
        EXPECT_NE(world.laser.noise, world.laser.statedNoise);
        EXPECT_GT(world.laser.silentEvery, 0);
        EXPECT_GT(world.odometry.slipsPerMetre, 0);
        EXPECT_GT(world.camera.latencyJitter, 0);
        const auto any = [](const auto& all, const auto& is) {
            return std::any_of(all.begin(), all.end(), is);
        };
        EXPECT_TRUE(any(world.doors, [](const auto& d) { return d.isOpen(1) != d.isOpen(2); }));
        EXPECT_TRUE(any(world.posters, [](const auto& p) { return p.isMoved(2); }));
        EXPECT_TRUE(any(world.posters, [](const auto& p) { return p.gloss > 0; }));
        EXPECT_LE(CSimulator(world, {1, 1}).pictureCount(), 400u);
    }
}

}  // namespace
}  // namespace salma::simulator
