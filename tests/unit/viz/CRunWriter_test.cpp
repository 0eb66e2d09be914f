// SPDX-License-Identifier: BSD-3-Clause
#include <CTemporaryFolder.h>
#include <gtest/gtest.h>
#include <salma/viz/CCsvTable.h>
#include <salma/viz/CRunWriter.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "exampleRun.h"

namespace salma::viz {
namespace {

using association::ELandmarkKind;
using association::EReason;
using slam::EDecision;
using slam::TRunRecord;

/// The first lines of a file that a run folder must hold, character by character.
TEST(CRunWriter, WritesEachTableAsTheDesignNamesIt) {
    TRunRecord record;
    record.trajectory.resize(1);
    record.trajectory[0].time = 12.25;
    record.trajectory[0].pose = mrpt::poses::CPose2D(1.5, -2, 0);
    slam::TMapLandmark landmark;
    landmark.id = 3;
    landmark.mean = {1, 2};
    landmark.covariance << 0.04, 0, 0, 0.25;
    landmark.sightings = 5;
    landmark.firstTime = 1;
    landmark.lastTime = 2;
    record.landmarks = {landmark};
    record.associations = {{1.5, 0, ELandmarkKind::salient, 2, M_PI / 2, 10.5, 20, std::nan(""),
                            EDecision::created, 3, std::nan(""), std::nan(""), 0,
                            EReason::unexplained}};
    record.candidates = {{1.5, 1, 3, 0.5, std::nan(""), true, true},
                         {1.5, 1, 4, 12.5, -1, false, false}};
    record.innovations = {{1.5, "bearing_deg", -0.125, 2}};
    const test::CTemporaryFolder folder;
    CRunWriter(folder.path()).writeTables(record);
    EXPECT_EQ(test::readFile(folder / "trajectory.tum"), "12.250000 1.5 -2 0 0 0 0 1\n");
    EXPECT_EQ(test::readFile(folder / "landmarks.csv"),
              "id,kind,x_m,y_m,sigma_x_m,sigma_y_m,sightings,first_t_s,last_t_s\n"
              "3,corner,1,2,0.2,0.5,5,1.000000,2.000000\n");
    EXPECT_EQ(test::readFile(folder / "associations.csv"),
              "t_s,observation,kind,range_m,bearing_deg,u_px,v_px,decision,landmark_id,d2,log_lr,"
              "n_candidates,reason\n1.500000,0,salient,2,90,10.5,20,new,3,,,0,unexplained\n");
    EXPECT_EQ(test::readFile(folder / "candidates.csv"),
              "t_s,observation,landmark_id,d2,log_lr,chosen,in_gate\n1.500000,1,3,0.5,,1,1\n"
              "1.500000,1,4,12.5,-1,0,0\n");
    EXPECT_EQ(test::readFile(folder / "innovations.csv"),
              "t_s,component,value,sigma\n1.500000,bearing_deg,-0.125,2\n");
}

TEST(CRunWriter, NamesEveryDecision) {
    TRunRecord record;
    for (const auto decision : {EDecision::paired, EDecision::created, EDecision::deferred,
                                EDecision::clutter, EDecision::relocated, EDecision::provisional}) {
        record.associations.emplace_back();
        record.associations.back().decision = decision;
    }
    const test::CTemporaryFolder folder;
    CRunWriter(folder.path()).writeTables(record);
    const CCsvTable table((folder / "associations.csv").string(), associationColumns());
    const std::vector<std::string> names{"paired",  "new",       "deferred",
                                         "clutter", "relocated", "provisional"};
    ASSERT_EQ(table.rows(), names.size());
    for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(table.text(i, "decision"), names[i]);
    EXPECT_EQ(table.text(0, "landmark_id"), "") << "-1 is no landmark";
}

TEST(CRunWriter, NamesEveryReason) {
    const std::vector<std::string> names{"nearest",
                                         "identity",
                                         "unexplained",
                                         "near_landmark",
                                         "taken",
                                         "jointly_impossible",
                                         "ambiguous",
                                         "unsure_appearance",
                                         "improbable",
                                         "too_many",
                                         "not_finite",
                                         "bad_covariance",
                                         "repeated_identity"};
    for (std::size_t i = 0; i < names.size(); ++i)
        EXPECT_EQ(nameOf(static_cast<EReason>(i)), names[i]);
    EXPECT_EQ(names.size(), static_cast<std::size_t>(EReason::repeatedIdentity) + 1);
    EXPECT_THROW(nameOf(static_cast<EReason>(names.size())), std::invalid_argument);
}

TEST(CRunWriter, WritesTheRunningPathWhereItIsNotTheFinalOne) {
    TRunRecord record;
    record.trajectory.resize(1);
    record.trajectory[0].time = 12.25;
    record.trajectory[0].running = mrpt::poses::CPose2D(1.5, -2, 0);
    const test::CTemporaryFolder plain, smoothed;
    CRunWriter(plain.path()).writeTables(record);
    EXPECT_FALSE(std::filesystem::exists(plain / "running.tum"));
    record.smoothed = true;
    CRunWriter(smoothed.path()).writeTables(record);
    EXPECT_EQ(test::readFile(smoothed / "running.tum"), "12.250000 1.5 -2 0 0 0 0 1\n");
    EXPECT_EQ(test::readFile(smoothed / "trajectory.tum"), "12.250000 0 0 0 0 0 0 1\n");
}

TEST(CRunWriter, WritesTablesThatReadBackToTheRecord) {
    const auto run = test::hallwayRun();
    const auto& record = run.record;
    const test::CTemporaryFolder folder;
    CRunWriter(folder.path()).writeTables(record);
    const auto trajectory = readTum((folder / "trajectory.tum").string());
    ASSERT_EQ(trajectory.size(), record.trajectory.size());
    for (std::size_t i = 0; i < trajectory.size(); ++i) {
        EXPECT_NEAR(trajectory[i].time, record.trajectory[i].time, 1e-6);
        EXPECT_NEAR(trajectory[i].T_w_r.distanceTo(record.trajectory[i].pose), 0, 1e-7);
    }
    const CCsvTable landmarks((folder / "landmarks.csv").string(), landmarkColumns());
    ASSERT_EQ(landmarks.rows(), record.landmarks.size());
    for (std::size_t i = 0; i < landmarks.rows(); ++i) {
        EXPECT_EQ(landmarks.integer(i, "id"), record.landmarks[i].id);
        EXPECT_NEAR(landmarks.number(i, "y_m"), record.landmarks[i].mean.y, 1e-7);
        EXPECT_NEAR(std::pow(landmarks.number(i, "sigma_x_m"), 2),
                    record.landmarks[i].covariance(0, 0), 1e-9);
    }
    const CCsvTable associations((folder / "associations.csv").string(), associationColumns());
    ASSERT_EQ(associations.rows(), record.associations.size());
    for (std::size_t i = 0; i < associations.rows(); ++i) {
        const auto& row = record.associations[i];
        EXPECT_EQ(associations.integerOr(i, "landmark_id", -1), row.landmark);
        EXPECT_NEAR(associations.number(i, "bearing_deg") * M_PI / 180, row.bearing, 1e-9);
        EXPECT_EQ(std::isnan(associations.numberOrNaN(i, "u_px")), std::isnan(row.u));
    }
    EXPECT_EQ(CCsvTable((folder / "candidates.csv").string(), candidateColumns()).rows(),
              record.candidates.size());
    const CCsvTable innovations((folder / "innovations.csv").string(), innovationColumns());
    ASSERT_EQ(innovations.rows(), record.innovations.size());
    for (std::size_t i = 0; i < innovations.rows(); ++i)
        EXPECT_NEAR(innovations.number(i, "value"), record.innovations[i].value, 1e-8);
}

TEST(CRunWriter, SummarisesTheRunAsJson) {
    auto run = test::hallwayRun();
    run.record.refused = {{"no border", 4}, {"grazing", 2}};
    run.record.splitGroups = 3;
    const test::CTemporaryFolder folder;
    CRunWriter(folder.path()).writeTables(run.record);
    const auto json = nlohmann::json::parse(test::readFile(folder / "summary.json"));
    const auto& rows = run.record.associations;
    EXPECT_EQ(json["steps"], run.record.trajectory.size());
    EXPECT_EQ(json["landmarks"], 24);
    EXPECT_EQ(json["paired"].get<std::size_t>() + json["new"].get<std::size_t>(), rows.size() / 2);
    EXPECT_EQ(json["deferred"], rows.size() / 2);
    EXPECT_EQ(json["clutter"], 0);
    EXPECT_EQ(json["relocated"], 0);
    EXPECT_EQ(json["pictures"], 300);
    EXPECT_EQ(json["pictures_without_landmark"], 120);
    EXPECT_EQ(json["refused"]["no border"], 4);
    EXPECT_EQ(json["refused"].size(), 2U);
    EXPECT_EQ(json["split_groups"], 3);
    EXPECT_EQ(json["provisional"], 0);
    EXPECT_EQ(json["seconds"], 42.5);
    EXPECT_EQ(json["seed"], 7);
    EXPECT_EQ(json["options"]["association"]["method"], "saliency");
    EXPECT_EQ(json["notices"].size(), 1U);
}

TEST(CRunWriter, SurvivesTextThatIsNotUtf8) {
    TRunRecord record;
    record.notices = {"picture \xff\xfe is gone"};
    const test::CTemporaryFolder folder;
    CRunWriter(folder.path()).writeTables(record);
    EXPECT_NO_THROW(nlohmann::json::parse(test::readFile(folder / "summary.json")).dump());
}

TEST(CRunWriter, NamesTheFileThatDoesNotFitOnTheDisk) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "SKIPPED, no /dev/full here";
    const auto run = test::hallwayRun();
    for (const std::string name : {"trajectory.tum", "associations.csv", "summary.json", "map.png",
                                   "scene.3Dscene", "report.html"}) {
        const test::CTemporaryFolder folder;
        std::filesystem::create_symlink("/dev/full", folder / name);
        try {
            CRunWriter(folder.path()).writeAll({run.record, run.truth});
            FAIL() << name << " was written to a full disk";
        } catch (const std::runtime_error& e) {
            EXPECT_NE(std::string(e.what()).find(name), std::string::npos) << e.what();
        }
    }
}

TEST(CRunWriter, WritesWhichLandmarksVotedForARelocation) {
    TRunRecord record;
    slam::TRelocationRow row;
    row.time = 12.5;
    row.outcome = "joined";
    row.kind = association::ELandmarkKind::salient;
    row.local = 31;
    row.left = 4;
    row.distance = 0.05;
    row.logRatio = 2.5;
    row.shiftX = -1;
    row.shiftY = 3;
    row.turn = M_PI / 6;
    row.posters = 6;
    row.corners = 7.5;
    row.odometry = -3.5;
    row.margin = 9;
    record.relocations = {row};
    row.outcome = "unproved";
    row.kind = association::ELandmarkKind::corner;
    row.logRatio = std::numeric_limits<double>::quiet_NaN();
    row.margin = std::numeric_limits<double>::infinity();  // no other alignment
    record.relocations.push_back(row);
    record.joins = 1;
    const test::CTemporaryFolder folder;
    CRunWriter(folder.path()).writeTables(record);
    EXPECT_EQ(test::readFile(folder / "relocations.csv"),
              "t_s,outcome,kind,local_id,left_id,distance_m,log_lr,shift_x_m,shift_y_m,turn_deg,"
              "posters,corners,odometry,margin\n"
              "12.500000,joined,salient,31,4,0.05,2.5,-1,3,30,6,7.5,-3.5,9\n"
              "12.500000,unproved,corner,31,4,0.05,,-1,3,30,6,7.5,-3.5,\n");
    EXPECT_NE(test::readFile(folder / "summary.json").find("\"joins\": 1"), std::string::npos);
}

TEST(CRunWriter, RefusesAFolderThatDoesNotExist) {
    EXPECT_THROW(CRunWriter("/no/such/folder").writeTables({}), std::runtime_error);
}

TEST(CRunWriter, LeavesEveryFileOfARunAlsoOfAnEmptyOne) {
    const TRunRecord empty;
    const test::CTemporaryFolder folder;
    CRunWriter(folder.path()).writeAll({empty, std::nullopt});
    for (const auto* name : {"trajectory.tum", "landmarks.csv", "associations.csv",
                             "candidates.csv", "innovations.csv", "relocations.csv", "summary.json",
                             "map.png", "innovations.png", "scene.3Dscene", "report.html"})
        EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
}

}  // namespace
}  // namespace salma::viz
