// SPDX-License-Identifier: BSD-3-Clause
#include <CTemporaryFolder.h>
#include <TTruth.h>
#include <gtest/gtest.h>

#include <cmath>
#include <exception>
#include <random>
#include <set>
#include <string>

namespace salma::apps {
namespace {

using test::CTemporaryFolder;

const std::string kLandmarks =
    "id,kind,x_m,y_m,z_m,yaw_deg,width_m,height_m,texture\n"
    "1,salient,4,1,1.5,180,0.6,0.4,a.jpg\n2,salient,4,-1,1.5,-90,0.6,0.4,b.jpg\n"
    "3,corner,2,0,0.3,,,,\n";
const std::string kSightings =
    "t_s,landmark_id,u_px,v_px,range_m,bearing_deg\n"
    "10.000000,1,100,200,4,14\n10.000000,2,500,200,4,-14\n10.000000,3,,,2,0\n";
const std::string kPath = "9 0 0 0 0 0 0 1\n10 0 0 0 0 0 0 1\n11 1 0 0 0 0 0 1\n";

TTruth load(const std::string& landmarks,
            const std::string& sightings = kSightings,
            const std::string& path = kPath) {
    const CTemporaryFolder folder;
    folder.write("w.landmarks.csv", landmarks);
    folder.write("w.sightings.csv", sightings);
    folder.write("w.gt.tum", path);
    return loadTruth(folder.path(), "");
}

/// What the error says; "" if there is none.
template <class... TEXTS>
std::string complaint(const TEXTS&... texts) {
    try {
        load(texts...);
        return "";
    } catch (const std::exception& e) {
        return e.what();
    }
}

void expectComplaint(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

TEST(TTruth, KnowsWhatHangsWhere) {
    const TTruth truth = load(kLandmarks);
    EXPECT_EQ(truth.name, "w");
    ASSERT_EQ(truth.landmarks.size(), 3U);
    EXPECT_EQ(truth.landmarks[1].texture, "b.jpg");
    EXPECT_NEAR(truth.landmarks[1].yaw, -M_PI / 2, 1e-12);
    EXPECT_TRUE(std::isnan(truth.landmarks[2].yaw));
    EXPECT_EQ(truth.landmarks[2].texture, "");
    EXPECT_EQ(truth.sightings.size(), 3U);
    EXPECT_EQ(truth.path->size(), 3U);
}

TEST(TTruth, NamesFileLineAndValueOfWhatIsWrong) {
    expectComplaint(complaint(replaced(kLandmarks, "180", "nan")),
                    "w.landmarks.csv:2: yaw_deg = 'nan' is not a finite number");
    expectComplaint(complaint(replaced(kLandmarks, "180", "")), "w.landmarks.csv:2: yaw_deg = ''");
    expectComplaint(complaint(replaced(kLandmarks, "a.jpg", "")),
                    "w.landmarks.csv:2: texture = '' names no texture");
    expectComplaint(complaint(replaced(kLandmarks, "2,salient", "1,salient")), ":3: id = '1'");
    expectComplaint(complaint(replaced(kLandmarks, "texture\n", "picture\n")),
                    "w.landmarks.csv:1: the header must be");
    expectComplaint(complaint(replaced(kLandmarks, ",b.jpg", "")), ":3: 8 cells instead of 9");
    expectComplaint(complaint(kLandmarks, replaced(kSightings, ",4,14", ",inf,14")),
                    "w.sightings.csv:2: range_m = 'inf'");
    expectComplaint(complaint(kLandmarks, replaced(kSightings, "00,2,", "00,7,")),
                    "w.sightings.csv:3: landmark_id = '7'");
    expectComplaint(complaint(kLandmarks, kSightings, replaced(kPath, "11 1", "11 x")),
                    "w.gt.tum:3");
}

/// A few bytes changed, cut out or put in, or the rest cut off.
std::string mutated(std::string text, std::mt19937& random) {
    static const std::string kPieces[] = {
        "nan",  "inf",     "-",     ",", "\n", "1e999", "\"", "999999999999", std::string(1, '\0'),
        "\xff", "salient", "corner"};
    for (unsigned n = 1 + random() % 4; n-- > 0 && !text.empty();) {
        const std::size_t place = random() % text.size();
        switch (random() % 4) {
            case 0:
                text[place] = static_cast<char>(random() % 256);
                break;
            case 1:
                text.erase(place, 1 + random() % 5);
                break;
            case 2:
                text.insert(place, kPieces[random() % std::size(kPieces)]);
                break;
            default:
                text.resize(place);
        }
    }
    return text;
}

TEST(TTruth, IsSoundOrRefusedHoweverTheFilesAreDamaged) {
    std::mt19937 random(1);
    int refused = 0, taken = 0;
    for (int i = 0; i < 3000; ++i) {
        std::string texts[] = {kLandmarks, kSightings, kPath};
        std::string& victim = texts[random() % 3];
        victim = mutated(victim, random);
        TTruth truth;
        try {
            truth = load(texts[0], texts[1], texts[2]);
        } catch (const std::exception& e) {
            ++refused;
            ASSERT_NE(std::string(e.what()).find("/w."), std::string::npos) << e.what();
            continue;
        }
        ++taken;
        std::set<int> ids;
        for (const auto& l : truth.landmarks) {
            ASSERT_TRUE(ids.insert(l.id).second && l.id >= 0);
            ASSERT_TRUE(std::isfinite(l.position.x) && std::isfinite(l.position.y));
            const bool salient = l.kind == association::ELandmarkKind::salient;
            ASSERT_EQ(salient, std::isfinite(l.yaw));
            ASSERT_EQ(salient, !l.texture.empty());
        }
        double last = -INFINITY;
        for (const auto& s : truth.sightings) {
            ASSERT_EQ(ids.count(s.landmark), 1U);
            ASSERT_TRUE(s.time >= last && std::isfinite(s.range) && std::isfinite(s.bearing));
            last = s.time;
        }
    }
    EXPECT_GT(refused, 1000);
    EXPECT_GT(taken, 100);  // a changed digit is still a number
}

}  // namespace
}  // namespace salma::apps
