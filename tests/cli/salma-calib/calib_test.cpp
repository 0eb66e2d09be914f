// SPDX-License-Identifier: BSD-3-Clause
#include <CProcess.h>
#include <CTemporaryFolder.h>
#include <gtest/gtest.h>
#include <mrpt/config/CConfigFile.h>
#include <mrpt/containers/yaml.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CRawlog.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "CSimulatedRig.h"
#include "tsaiPicture.h"

namespace salma {
namespace {

namespace fs = std::filesystem;
using calibration::CSimulatedRig;
using test::CTemporaryFolder;
using test::readFile;
using test::TProcessResult;

TProcessResult calib(const std::vector<std::string>& arguments) {
    std::vector<std::string> command{test::program("salma-calib")};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return test::runProcess(command);
}

void expectError(const TProcessResult& result, int exitCode, const std::string& part) {
    EXPECT_EQ(result.exitCode, exitCode) << result.output;
    EXPECT_NE(result.output.find(part), std::string::npos) << part << "\n" << result.output;
}

/// Pictures and scans of a simulated rig, made once for all tests.
class SalmaCalib : public testing::Test {
 protected:
    static constexpr int kPairs = 8;

    static void SetUpTestSuite() {
        s_folder = new CTemporaryFolder;
        s_rig = new CSimulatedRig(31);
        s_rig->tilt = 0.8;
        const auto pairs = s_rig->pairs(kPairs);
        std::ostringstream scans;
        scans.precision(9);
        for (int i = 0; i < kPairs; ++i) {
            const auto k = static_cast<std::size_t>(i);
            const std::string file = (*s_folder / ("p" + std::to_string(i) + ".png")).string();
            cv::imwrite(file, s_rig->picture(s_rig->boards()[k]));
            images().push_back(file);
            const auto& scan = pairs[k].scan;
            scans << i << " " << scan.start << " " << scan.step << " "
                  << scan.direction(scan.ranges.size() - 1) << " 8 " << scan.ranges.size();
            for (const double r : scan.ranges) scans << ", " << r;
            scans << "\n";
        }
        s_folder->write("scans.txt", scans.str());
        const auto& camera = s_rig->camera();
        std::ostringstream ini;
        ini << "[CAMERA_PARAMS]\nresolution = [640 480]\nfx = " << camera.fx()
            << "\nfy = " << camera.fy() << "\ncx = " << camera.cx() << "\ncy = " << camera.cy()
            << "\ndist = [-0.25 0.1 0.001 -0.0005 0]\ndistortion_model = plumb_bob\n";
        s_folder->write("camera.ini", ini.str());
    }
    static void TearDownTestSuite() {
        delete s_folder;
        delete s_rig;
        images().clear();
    }

    static std::vector<std::string>& images() {
        static std::vector<std::string> all;
        return all;
    }
    static std::string in(const std::string& name) { return (*s_folder / name).string(); }

    /// The arguments of a command on all pictures, with more behind.
    static std::vector<std::string> with(const std::string& command,
                                         const std::vector<std::string>& more,
                                         std::vector<std::string> pictures = images()) {
        std::vector<std::string> all{command};
        all.insert(all.end(), pictures.begin(), pictures.end());
        all.insert(all.end(), {"--board", "9x6", "--square-m", "0.1"});
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }

    static inline CTemporaryFolder* s_folder = nullptr;
    static inline CSimulatedRig* s_rig = nullptr;
};

TEST_F(SalmaCalib, CameraWritesWhatMrptReads) {
    const CTemporaryFolder folder;
    const std::string out = (folder / "out").string();
    const auto result = calib(with("camera", {"--out", out}));
    ASSERT_EQ(result.exitCode, 0) << result.output;
    EXPECT_NE(result.output.find("8 of 8 pictures show the board"), std::string::npos);
    EXPECT_NE(result.output.find("px fitted, held out 0."), std::string::npos) << result.output;
    mrpt::img::TCamera camera;
    camera.loadFromConfigFile("CAMERA_PARAMS", mrpt::config::CConfigFile(out + "/camera.ini"));
    EXPECT_NEAR(camera.fx(), s_rig->camera().fx(), 4);
    EXPECT_NEAR(camera.cy(), s_rig->camera().cy(), 4);
    EXPECT_NEAR(camera.k1(), -0.25, 0.03);
    EXPECT_EQ(camera.ncols, 640u);
    const auto yaml = mrpt::img::TCamera::FromYAML(
        mrpt::containers::yaml::FromText(readFile(out + "/camera.yaml")));
    EXPECT_EQ(yaml.fx(), camera.fx());
    EXPECT_EQ(yaml.k2(), camera.k2());
    EXPECT_EQ(yaml.nrows, 480u);
    for (const std::string name : {"report.html", "residuals.png", "residuals.csv"})
        EXPECT_GT(fs::file_size(out + "/" + name), 1000u) << name;
    EXPECT_NE(readFile(out + "/calibration.json").find("\"heldout_rms_px\""), std::string::npos);
}

TEST_F(SalmaCalib, CameraNamesPicturesThatDoNotServe) {
    const CTemporaryFolder folder;
    const std::string out = (folder / "out").string();
    const std::string empty = (folder / "empty.png").string();
    const std::string small = (folder / "small.png").string();
    cv::imwrite(empty, cv::Mat(480, 640, CV_8U, cv::Scalar(100)));
    cv::imwrite(small, cv::Mat(240, 320, CV_8U, cv::Scalar(100)));
    auto more = std::vector<std::string>(images().begin(), images().begin() + 4);
    more.push_back(empty);
    expectError(calib(with("camera", {"--out", out}, more)), 1, empty + ": no board of 9x6 points");
    const auto allowed = calib(with("camera", {"--out", out, "--allow-missing"}, more));
    EXPECT_EQ(allowed.exitCode, 0) << allowed.output;
    EXPECT_NE(allowed.output.find("4 of 5 pictures show the board"), std::string::npos);
    EXPECT_NE(readFile(out + "/calibration.json").find("empty.png"), std::string::npos);

    const std::string no = (folder / "no").string();
    expectError(calib(with("camera", {"--out", no}, {images()[0], small})), 1,
                small + ": is 320x240, but " + images()[0] + " is 640x480");
    expectError(calib(with("camera", {"--out", no}, {images()[0], images()[1]})), 1,
                "needs 3 pictures");
    expectError(calib(with("camera", {"--out", no}, {images()[0], images()[0]})), 1,
                "would be named p0");
    expectError(calib(with("camera", {"--out", no}, {in("scans.txt")})), 1,
                "cannot be read as a picture");
    expectError(calib(with("camera", {"--out", no}, {in("none.png")})), 1, "none.png: is missing");
    EXPECT_FALSE(fs::exists(no));
}

TEST_F(SalmaCalib, LaserCameraWritesThePoseThatRawlogEditPutsIntoALog) {
    const CTemporaryFolder folder;
    const std::string out = (folder / "out").string();
    const auto result =
        calib(with("laser-camera",
                   {"--scans", in("scans.txt"), "--camera", in("camera.ini"), "--label", "CAMERA",
                    "--laser-pose-m-deg", "0.2", "0", "0.3", "90", "0", "0", "--out", out}));
    ASSERT_EQ(result.exitCode, 0) << result.output;
    EXPECT_NE(result.output.find("8 of 8 pictures and scans agree"), std::string::npos);
    for (const std::string name : {"report.html", "distances.png", "p0.laser.png"})
        EXPECT_GT(fs::file_size(out + "/" + name), 1000u) << name;

    const mrpt::poses::CPose3D truth =
        mrpt::poses::CPose3D(0.2, 0, 0.3, M_PI / 2, 0, 0) + s_rig->T_l_c();
    const std::string log = std::string(SALMA_SOURCE_DIR) + "/rawlogs/hallway-loop.rawlog";
    const std::string posed = (folder / "posed.rawlog").string();
    const std::string done = (folder / "done.rawlog").string();
    ASSERT_EQ(test::runProcess(
                  {"rawlog-edit", "-i", log, "-o", posed, "--sensors-pose", out + "/sensors.ini"})
                  .exitCode,
              0);
    ASSERT_EQ(test::runProcess({"rawlog-edit", "-i", posed, "-o", done, "--camera-params",
                                "CAMERA," + out + "/camera.ini"})
                  .exitCode,
              0);
    mrpt::obs::CRawlog rawlog;
    ASSERT_TRUE(rawlog.loadFromRawLogFile(done));
    int pictures = 0;
    for (const auto& entry : rawlog) {
        const auto picture = std::dynamic_pointer_cast<mrpt::obs::CObservationImage>(entry);
        if (!picture) continue;
        ++pictures;
        ASSERT_LT((picture->cameraPose - truth).norm(), 0.03) << picture->cameraPose;
        ASSERT_LT(std::abs(picture->cameraPose.yaw() - truth.yaw()), 0.02);
        ASSERT_EQ(picture->cameraParams.fx(), s_rig->camera().fx());
        ASSERT_EQ(picture->cameraParams.k2(), 0.1);
    }
    EXPECT_GT(pictures, 100);
}

TEST_F(SalmaCalib, LaserCameraTakesAScannerThatHangsUpsideDown) {
    const CTemporaryFolder folder;
    std::istringstream lines(readFile(in("scans.txt")));
    std::string mirrored;  // the same scans, counted from the other side
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string stamp, start, step, end, rest;
        words >> stamp >> start >> step >> end;
        std::getline(words, rest);
        const auto flip = [](const std::string& n) { return n[0] == '-' ? n.substr(1) : "-" + n; };
        mirrored += stamp + " " + flip(start) + " " + flip(step) + " " + flip(end) + rest + "\n";
    }
    const std::string scans = folder.write("scans.txt", mirrored);
    const auto upright =
        calib(with("laser-camera", {"--scans", in("scans.txt"), "--camera", in("camera.ini"),
                                    "--out", (folder / "a").string()}));
    const auto hanging =
        calib(with("laser-camera", {"--scans", scans, "--clockwise", "--camera", in("camera.ini"),
                                    "--out", (folder / "b").string()}));
    ASSERT_EQ(hanging.exitCode, 0) << hanging.output;
    EXPECT_EQ(readFile(folder / "a/sensors.ini"), readFile(folder / "b/sensors.ini"));
}

TEST_F(SalmaCalib, LaserCameraNamesFileAndLineOfAMistake) {
    const CTemporaryFolder folder;
    const std::string out = (folder / "out").string(), good = readFile(in("scans.txt"));
    const auto run = [&](const std::string& scans, const std::string& camera,
                         const std::vector<std::string>& more = {}) {
        std::vector<std::string> all{"--scans", scans, "--camera", camera, "--out", out};
        all.insert(all.end(), more.begin(), more.end());
        return calib(with("laser-camera", all));
    };
    const std::string cut = folder.write("cut.txt", good.substr(0, good.size() - 100));
    expectError(run(cut, in("camera.ini")), 1, cut + ":8: breaks off after ");
    const std::string few = folder.write("few.txt", good.substr(0, good.rfind("\n7 ") + 1));
    expectError(run(few, in("camera.ini")), 1, few + ": has 7 lines, but scans 1 to 8 are needed");
    expectError(run(in("scans.txt"), in("camera.ini"), {"--first-scan", "2"}), 1,
                "has 8 lines, but scans 2 to 9 are needed");
    expectError(run(in("none.txt"), in("camera.ini")), 1, "none.txt: is missing");

    const std::string ini = readFile(in("camera.ini"));
    const auto camera = [&](const std::string& from, const std::string& to) {
        std::string text = ini;
        text.replace(text.find(from), from.size(), to);
        return folder.write("camera.ini", text);
    };
    expectError(run(in("scans.txt"), camera("fx = 520", "fx = 52o")), 1, "fx = '52o'");
    expectError(run(in("scans.txt"), camera("fx = 520\n", "")), 1, "fx");
    expectError(run(in("scans.txt"), camera("[640 480]", "[640]")), 1, "resolution");
    expectError(run(in("scans.txt"), camera("[640 480]", "[320 240]")), 1,
                "is of pictures of 320x240, but");
    expectError(run(in("scans.txt"), camera("[-0.25 ", "[nan ")), 1, "'nan', which is no number");
    expectError(run(in("scans.txt"), camera("plumb_bob", "fisheye")), 1, "'fisheye'");
    expectError(run(in("scans.txt"), camera("plumb_bob", "none")), 1, "dist");
    expectError(run(in("scans.txt"), camera("distortion_model", "distortion")), 1, "distortion");
    expectError(run(in("scans.txt"), camera("[CAMERA_PARAMS]", "[CAM]")), 1,
                "has no section [CAMERA_PARAMS]");
    expectError(run(in("scans.txt"), camera("fx = 520", "fx = 520\nfz = 2")), 1, "fz");
    EXPECT_FALSE(fs::exists(out));
}

TEST_F(SalmaCalib, TsaiFindsACameraAndChecksItAgainstOtherPoints) {
    const CTemporaryFolder folder;
    const calibration::TTsaiCamera truth;
    const std::string image = (folder / "grid.png").string();
    cv::imwrite(image, calibration::tsaiPicture(truth.K, truth.R, truth.t));
    std::ostringstream points;  // in mm, counted from the second square
    for (const auto& X : {Eigen::Vector3d(0.04, 0.06, 0), {0.12, 0.1, 0}, {0.08, 0, 0.12}}) {
        const Eigen::Vector3d x = truth.K * (truth.R * X + truth.t);
        points << 1e3 * X.x() - 20 << " " << 1e3 * X.y() << " " << 1e3 * X.z() << " "
               << x.x() / x.z() << " " << x.y() / x.z() << "\n";
    }
    const std::string check = folder.write("points.txt", points.str());
    const std::string out = (folder / "out").string();
    const auto result = calib({"tsai", image, "--square-m", "0.02", "--check", check,
                               "--check-unit-m", "0.001", "--out", out});
    ASSERT_EQ(result.exitCode, 0) << result.output;
    EXPECT_NE(result.output.find("check: 3 points, 0."), std::string::npos) << result.output;
    for (const std::string name : {"report.html", "residuals.png", "grid.png", "points.csv"})
        EXPECT_GT(fs::file_size(out + "/" + name), 1000u) << name;
    mrpt::img::TCamera camera;
    camera.loadFromConfigFile("CAMERA_PARAMS", mrpt::config::CConfigFile(out + "/camera.ini"));
    EXPECT_NEAR(camera.fx(), 900, 20);
    EXPECT_EQ(camera.ncols, 800u);
}

TEST_F(SalmaCalib, TsaiNamesWhatDoesNotServe) {
    const CTemporaryFolder folder;
    const std::string no = (folder / "no").string();
    const auto tsai = [&](const std::string& image, const std::vector<std::string>& more = {}) {
        std::vector<std::string> all{"tsai", image, "--square-m", "0.02", "--out", no};
        all.insert(all.end(), more.begin(), more.end());
        return calib(all);
    };
    const std::string empty = (folder / "empty.png").string();
    cv::imwrite(empty, cv::Mat(300, 400, CV_8U, cv::Scalar(100)));
    expectError(tsai(empty), 1, empty + ": only 0 corners hang together in a grid; 28 are needed");
    expectError(tsai(images()[0]), 1, "are not of two boards at a right angle");
    const calibration::TTsaiCamera truth;
    const std::string good = (folder / "grid.png").string();
    cv::imwrite(good, calibration::tsaiPicture(truth.K, truth.R, truth.t));
    const std::string cut = folder.write("cut.txt", "20 160 0 860 1320\n20 160 0 8");
    expectError(tsai(good, {"--check", cut}), 1, cut + ":2: has 4 numbers, not x y z u v");
    const std::string none = folder.write("none.txt", "# nothing\n");
    expectError(tsai(good, {"--check", none}), 1, none + ": holds no points");
    EXPECT_FALSE(fs::exists(no));
    expectError(calib({"tsai"}), 2, "IMAGE is required");
    expectError(calib({"tsai", "a.png"}), 2, "--out is required");
    expectError(calib({"tsai", "a.png", "--out", "x"}), 2, "--square-m");
    expectError(calib({"tsai", "a.png", "--out", "x", "--square-m", "nan"}), 2, "--square-m");
}

TEST_F(SalmaCalib, RefusesMisuseWithCodeTwo) {
    const std::vector<std::string> end{"--square-m", "0.1", "--out", "x"};
    const auto camera = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "camera");
        return calib(arguments);
    };
    expectError(camera({}), 2, "IMAGE is required");
    expectError(camera({"a.png"}), 2, "--board is required");
    for (const std::string board : {"9", "9x", "9x6x", "2x6", "9x-6", "x", "200x6"})
        expectError(camera({"a.png", "--out", "x", "--board", board}), 2, "--board");
    for (const std::string side : {"0", "-1", "nan", "inf"})
        expectError(camera({"a.png", "--out", "x", "--board", "9x6", "--square-m", side}), 2,
                    "--square-m");
    expectError(camera({"a.png", "--board", "9x6"}), 2, "--out is required");
    expectError(camera({"a.png", "--board", "8x8", "--pattern", "squares"}), 2, "gap");
    expectError(camera({"a.png", "--board", "8x8", "--gap-m", "1"}), 2, "--gap-m");
    expectError(camera({"a.png", "--board", "8x8", "--colour"}), 2, "--colour");
    const auto laser = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"laser-camera", "a.png", "--board", "9x6"});
        return calib(arguments);
    };
    expectError(laser({}), 2, "--scans is required");
    expectError(laser({"--scans", "s"}), 2, "--camera is required");
    expectError(laser({"--scans", "s", "--camera", "c"}), 2, "--out is required");
    const std::vector<std::string> all{"--scans", "s", "--camera", "c", "--out", "x"};
    const auto and_ = [&](std::vector<std::string> more) {
        more.insert(more.begin(), all.begin(), all.end());
        return laser(more);
    };
    expectError(and_({"--label", "[x]"}), 2, "--label");
    expectError(and_({"--first-scan", "0"}), 2, "--first-scan");
    expectError(and_({"--laser-pose-m-deg", "0", "0", "nan", "0", "0", "0"}), 2, "finite");
    expectError(and_({"--laser-pose-m-deg", "0", "0"}), 2, "--laser-pose-m-deg");
    expectError(calib({}), 2, "subcommand");
}

TEST_F(SalmaCalib, PrintsItsOptionsAndReadsThemBack) {
    const CTemporaryFolder folder;
    for (const std::string command : {"camera", "tsai", "laser-camera"}) {
        const auto printed = calib({command, "--print-config"});
        ASSERT_EQ(printed.exitCode, 0) << printed.output;
        const std::string ini = folder.write("own.ini", printed.output);
        EXPECT_EQ(calib({command, "--config", ini, "--print-config"}).output, printed.output);
        const std::string wrong = folder.write("wrong.ini", printed.output + "colour = 1\n");
        expectError(calib({command, "--config", wrong, "--print-config"}), 1, "colour");
    }
}

TEST_F(SalmaCalib, BeginsItsHelpWithExamples) {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                      {"camera", "--help"},
                                                      {"tsai", "--help"},
                                                      {"laser-camera", "--help"}}) {
        const auto result = calib(arguments);
        EXPECT_EQ(result.exitCode, 0);
        EXPECT_EQ(result.output.find("Examples:\n  salma-calib "), 0u) << result.output;
    }
}

}  // namespace
}  // namespace salma
