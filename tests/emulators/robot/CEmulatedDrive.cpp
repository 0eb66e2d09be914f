// SPDX-License-Identifier: BSD-3-Clause
#include "CEmulatedDrive.h"

#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

namespace salma::test {

using namespace simulator;

namespace {

constexpr std::size_t afterwards = 40;  // pictures at the end; a program should not run out of them

}  // namespace

CEmulatedDrive::CEmulatedDrive(const TWorld& description,
                               std::uint32_t seed,
                               const std::filesystem::path& folder,
                               std::size_t standing)
    : m_description(description),
      m_simulator(description, {seed, 2}),
      m_path(description.path, seed),
      m_plan(description.head, m_path, m_simulator.world(), seed),
      m_times(pictureTimes(m_plan, standing)),
      m_clock(m_times),
      m_wheels(description.odometry, seed),
      m_scanner(description, seed, [this](double now) { return m_path.pose(m_clock.at(now)); }),
      m_laser([this](const TLmsView& view, double now) { return m_scanner.scan(view, now); }),
      m_base("ODO", description.odometry.rate, [this](double now) { return odometry(now); }) {
    const auto pictures = folder / "pictures";
    std::filesystem::create_directories(pictures);
    writePictures(pictures, standing);
    writeSettings(folder);
    m_pictures = std::make_unique<CPictureFolder>(
        pictures, [this](std::size_t index) { m_clock.looked(index, CEmulator::now()); });
    m_laserEnd = std::make_unique<CEmulator>(m_laser, (folder / "laser").string());
    m_headEnd = std::make_unique<CEmulator>(m_head, (folder / "head").string());
    m_baseEnd = std::make_unique<CEmulator>(m_base, (folder / "base").string());
    m_remoteControl = std::thread([this] { turnHead(); });
}

CEmulatedDrive::~CEmulatedDrive() {
    m_stop = true;
    m_remoteControl.join();
}

std::vector<double> CEmulatedDrive::pictureTimes(const CHeadPlan& plan, std::size_t standing) {
    const auto& planned = plan.pictureTimes();
    if (planned.empty()) throw std::invalid_argument("the world's head plan takes no picture");
    std::vector<double> times(standing, planned.front());
    times.insert(times.end(), planned.begin(), planned.end());
    times.insert(times.end(), afterwards, planned.back());
    return times;
}

void CEmulatedDrive::writePictures(const std::filesystem::path& folder, std::size_t standing) {
    const std::size_t taken = m_simulator.pictureCount();
    for (std::size_t i = 0; i < taken; ++i) {
        const auto file = folder / CPictureFolder::name(standing + i);
        if (!cv::imwrite(file.string(), m_simulator.picture(i), {cv::IMWRITE_PNG_COMPRESSION, 1}))
            throw std::runtime_error(file.string() + ": cannot be written");
    }
    const auto first = folder / CPictureFolder::name(standing);
    const auto last = folder / CPictureFolder::name(standing + taken - 1);
    for (std::size_t i = 0; i < m_times.size(); ++i) {
        if (i >= standing && i < standing + taken) continue;
        const auto file = folder / CPictureFolder::name(i);
        std::filesystem::remove(file);  // of an earlier drive
        std::filesystem::create_hard_link(i < standing ? first : last, file);
    }
}

/// Between two pictures of the plan, the longest [s].
double CEmulatedDrive::picturePeriod() const {
    double longest = 0;
    for (std::size_t i = 1; i < m_times.size(); ++i)
        longest = std::max(longest, m_times[i] - m_times[i - 1]);
    return longest;
}

bool CEmulatedDrive::arrived() const { return m_clock.at(CEmulator::now()) >= m_times.back(); }

void CEmulatedDrive::writeTruth(const std::filesystem::path& file) {
    std::vector<TTruePose> truth;
    m_baseEnd->locked([&] { truth = m_truth; });
    std::ofstream out(file);
    out.precision(17);
    for (const auto& [stamp, pose] : truth)
        out << stamp << " " << pose.x << " " << pose.y << " 0 0 0 " << std::sin(pose.phi / 2) << " "
            << std::cos(pose.phi / 2) << "\n";
    if (!out.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

void CEmulatedDrive::writeSettings(const std::filesystem::path& folder) const {
    mrpt::config::CConfigFileMemory robot;
    std::ifstream shipped(SALMA_SOURCE_DIR "/share/grabber/robot.ini");
    robot.setContent(std::string(std::istreambuf_iterator<char>(shipped), {}));
    const auto path = [&](const char* name) { return (folder / name).string(); };
    robot.write("global", "rawlog_prefix", path("drive"));
    robot.write("LASER", "COM_port_LIN", path("laser"));
    robot.write("LASER", "COM_baudRate", "500000");
    robot.write("HEAD", "port", path("head"));
    robot.write("ODOMETRY", "port", path("base"));
    // A little slower than the world's pictures, so that the world waits and not the camera.
    robot.write("CAMERA", "process_rate", std::to_string(1 / (picturePeriod() + 0.01)));
    robot.write("CAMERA", "grabber_type", "image_dir");
    robot.write("CAMERA", "image_dir_url", path("pictures"));
    robot.write("CAMERA", "left_format", "%04d.png");
    robot.write("CAMERA", "start_index", "0");
    robot.write("CAMERA", "end_index", std::to_string(m_times.size() - 1));
    mrpt::config::CConfigFileMemory camera;
    m_simulator.camera().parameters().saveToConfigFile("CAMERA_PARAMS", camera);
    std::ofstream(folder / "robot.ini") << robot.getContent();
    std::ofstream(folder / "camera.ini") << camera.getContent();
}

std::vector<double> CEmulatedDrive::odometry(double now) {
    const auto truth = m_path.pose(m_clock.at(now));
    m_truth.push_back({now, truth});
    const auto pose = m_wheels.next(truth);
    return {pose.x, pose.y, mrpt::RAD2DEG(pose.phi)};
}

void CEmulatedDrive::turnHead() {
    while (!m_stop) {
        m_headEnd->locked([this] {
            const double now = CEmulator::now();
            m_head.turnTo(mrpt::RAD2DEG(m_plan.pan(m_clock.at(now))),
                          mrpt::RAD2DEG(m_description.head.tilt), now);
        });
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

}  // namespace salma::test
