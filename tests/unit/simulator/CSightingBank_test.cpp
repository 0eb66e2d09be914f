// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/observations/CLogReader.h>
#include <salma/simulator/CBankBuilder.h>
#include <salma/simulator/CSimulator.h>

#include <fstream>
#include <random>

#include "room.h"

namespace salma::simulator {
namespace {

using test::CTemporaryFolder;
using test::readFile;

/// A poster to the left of the path, which the camera sees at 34 deg; two pictures.
std::string posterIni() {
    return roomIni(
        "[head]\nmode = fixed:50\nperiod_s = 2\n"
        "[poster_p]\nwall = north\nat_m = 3.6\ncentre_height_m = 1.45\nwidth_m = 0.8\n"
        "height_m = 0.56\ntexture = notice\n");
}

TBankOptions small() {
    TBankOptions options;
    options.draws = 2;
    return options;
}

std::shared_ptr<const CSightingBank> bankOf(const TWorld& world, const CTemporaryFolder& folder) {
    const CBankBuilder builder(world, small());
    const auto file = folder / "a.bank";
    CSightingBank::write(file, builder.key(), builder.build());
    return std::make_shared<const CSightingBank>(file);
}

/// Two views without picture: no rendering needed to try the file.
std::filesystem::path writeEmptyViews(const CTemporaryFolder& folder) {
    const auto file = folder / "empty.bank";
    CSightingBank::write(file, "a = 1\nb = 2\n", {{TBankedView{{1, 2, 0.5}, 0.25, {}}, {}}, {{}}});
    return file;
}

std::string errorOf(const std::filesystem::path& file) {
    try {
        const CSightingBank bank(file);
        for (std::size_t draw = 0; draw < bank.draws(); ++draw)
            for (std::size_t i = 0; i < bank.pictures(draw); ++i) bank.view(draw, i);
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "";
}

void overwrite(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

std::vector<std::vector<float>> rangesIn(const std::filesystem::path& log) {
    std::vector<std::vector<float>> all;
    for (const auto& step : observations::readLog(log.string()).steps)
        for (const auto& o : step.observations)
            if (const auto scan =
                    std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(o)) {
                all.emplace_back();
                for (std::size_t i = 0; i < scan->getScanSize(); ++i)
                    all.back().push_back(scan->getScanRange(i));
            }
    return all;
}

TEST(CSightingBank, ReadsBackWhatWasWritten) {
    const CTemporaryFolder folder;
    const CSightingBank bank(writeEmptyViews(folder));
    EXPECT_EQ(bank.key(), "a = 1\nb = 2\n");
    ASSERT_EQ(bank.draws(), 2u);
    EXPECT_EQ(bank.pictures(0), 2u);
    EXPECT_EQ(bank.pictures(1), 1u);
    const TBankedView view = bank.view(0, 0);
    EXPECT_EQ(view.T_w_r, mrpt::math::TPose2D(1, 2, 0.5));
    EXPECT_EQ(view.pan, 0.25);
    EXPECT_THROW(bank.view(1, 1), std::out_of_range);
}

TEST(CSightingBank, ABankOfSomethingElseIsRefusedByName) {
    const CTemporaryFolder folder;
    const CSightingBank bank(writeEmptyViews(folder));
    EXPECT_NO_THROW(bank.requireKey("a = 1\nb = 2\n"));
    EXPECT_NO_THROW(bank.requireKey("a = 1  // other words, of other keys too\nb = 2\n"));
    try {
        bank.requireKey("a = 1\nb = 3\n");
        FAIL() << "accepted";
    } catch (const std::invalid_argument& e) {
        const std::string text = e.what();
        EXPECT_NE(text.find("empty.bank"), std::string::npos) << text;
        EXPECT_NE(text.find("'b = 2' where this run has 'b = 3'"), std::string::npos) << text;
    }
}

TEST(CSightingBank, TruncatedAtAnyByteIsRefused) {
    const CTemporaryFolder folder;
    const auto file = writeEmptyViews(folder);
    const std::string whole = readFile(file);
    ASSERT_EQ(errorOf(file), "");
    for (std::size_t size = 0; size < whole.size(); ++size) {
        overwrite(file, whole.substr(0, size));
        EXPECT_NE(errorOf(file).find("empty.bank: "), std::string::npos) << size << " bytes";
    }
    overwrite(file, whole + "x");
    EXPECT_NE(errorOf(file), "");
}

TEST(CSightingBank, AnyChangedByteIsFound) {
    const CTemporaryFolder folder;
    const auto file = writeEmptyViews(folder);
    const std::string whole = readFile(file);
    std::mt19937 random(1);
    for (std::size_t i = 0; i < whole.size(); ++i) {
        std::string broken = whole;
        broken[i] = static_cast<char>(broken[i] ^ static_cast<char>(1 + random() % 255));
        overwrite(file, broken);
        EXPECT_NE(errorOf(file), "") << "byte " << i;
    }
}

TEST(CSightingBank, ForeignFilesAreRefused) {
    const CTemporaryFolder folder;
    EXPECT_NE(errorOf(folder / "gone.bank").find("no such bank"), std::string::npos);
    EXPECT_NE(errorOf(folder.write("text.bank", "hello")).find("is not a bank"), std::string::npos);
    EXPECT_THROW(CSightingBank::write(folder / "no/such/folder/x.bank", "", {}),
                 std::runtime_error);
}

TEST(CBankBuilder, AHeadThatFollowsPostersHasNoBank) {
    const CTemporaryFolder folder;
    TWorld world = load(folder, posterIni());
    world.head.mode = "attend";
    EXPECT_THROW(CBankBuilder(world, small()), std::invalid_argument);
}

TEST(CBankBuilder, ItsKeyNamesAllButTheOdometry) {
    const CTemporaryFolder folder;
    TWorld world = load(folder, posterIni());
    const std::string key = CBankBuilder(world, small()).key();
    world.odometry.level = EOdometryNoise::high;
    EXPECT_EQ(CBankBuilder(world, small()).key(), key);
    world.camera.noise = 3;
    EXPECT_NE(CBankBuilder(world, small()).key(), key);
    TBankOptions options = small();
    options.seeing.border.grow *= 2;
    world.camera.noise = TCameraOptions().noise;
    EXPECT_NE(CBankBuilder(world, options).key(), key);
}

TEST(CBankBuilder, SameBytesWhateverTheThreads) {
    const CTemporaryFolder folder;
    const TWorld world = load(folder, posterIni());
    TBankOptions two = small();
    two.threads = 2;
    const CBankBuilder one(world, small()), other(world, two);
    CSightingBank::write(folder / "1.bank", one.key(), one.build());
    CSightingBank::write(folder / "2.bank", other.key(), other.build());
    EXPECT_TRUE(readFile(folder / "1.bank") == readFile(folder / "2.bank"));
}

TEST(CBankedFrontEnd, SeesThePosterWhereThisRunHasIt) {
    const CTemporaryFolder folder;
    const TWorld world = load(folder, posterIni());
    const auto bank = bankOf(world, folder);
    const CSimulator drive(world, {7, 1, bank});
    const CBankedFrontEnd frontEnd(bank, 7);
    std::size_t seen = 0;
    for (std::size_t i = 0; i < drive.pictureCount(); ++i) {
        const auto record = frontEnd.look(drive, i);
        ASSERT_TRUE(record);
        const auto& truth = drive.landmarks().front();
        for (const auto& patch : record->landmarks) {
            const auto T_w_p =
                mrpt::poses::CPose3D(drive.truePose(drive.pictureTime(i))) + patch.pose.mean;
            EXPECT_NEAR(T_w_p.x(), truth.centre.x(), 0.06);
            EXPECT_NEAR(T_w_p.y(), truth.centre.y(), 0.03);
            EXPECT_NEAR(T_w_p.z(), truth.centre.z(), 0.06);
            EXPECT_GT(patch.keypoints.size(), 5u);
            ++seen;
        }
    }
    EXPECT_GT(seen, 0u);
}

TEST(CBankedFrontEnd, OdometryNoiseChangesNothingButTheOdometry) {
    const CTemporaryFolder folder, low, high;
    TWorld world = load(folder, posterIni());
    const auto bank = bankOf(world, folder);
    world.odometry.level = EOdometryNoise::low;
    CSimulator(world, {3, 1, bank}).run(low.path());
    world.odometry.level = EOdometryNoise::high;
    CSimulator(world, {3, 1, bank}).run(high.path());
    for (const char* name :
         {"room.salient.rawlog", "room.gt.tum", "room.landmarks.csv", "room.sightings.csv"})
        EXPECT_TRUE(readFile(low / name) == readFile(high / name)) << name;
    EXPECT_FALSE(readFile(low / "room.rawlog") == readFile(high / "room.rawlog"));
    const auto scans = rangesIn(low / "room.rawlog");
    EXPECT_GT(scans.size(), 10u);
    EXPECT_EQ(scans, rangesIn(high / "room.rawlog"));
    EXPECT_FALSE(std::filesystem::exists(low / "room_Images"));
}

TEST(CBankedFrontEnd, ABankOfAnotherDriveIsNotUsed) {
    const CTemporaryFolder folder;
    TWorld world = load(folder, posterIni());
    const auto bank = bankOf(world, folder);
    world.head.mode = "fixed:20";
    const CSimulator drive(world, {1, 1, bank});
    EXPECT_THROW(CBankedFrontEnd(bank, 1).look(drive, 0), std::runtime_error);
}

}  // namespace
}  // namespace salma::simulator
