// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/Clock.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/poses/CPose2D.h>
#include <salma/simulator/CSimulator.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "inParallel.h"
#include "seeds.h"
#include "truthFiles.h"

namespace salma::simulator {

using mrpt::math::TPose2D;
using mrpt::poses::CPose3D;
using observations::CObservationPanTilt;

namespace {

constexpr std::int64_t kEpoch = 1700000000;  // stamp of the start of every run [s since 1970]

/// Times are whole microseconds, so that stamps survive every file format.
double rounded(double time) { return std::round(time * 1e6) * 1e-6; }

double stampOf(double time) { return static_cast<double>(kEpoch) + time; }

mrpt::Clock::time_point clockTime(double time) {
    constexpr std::int64_t from1601 = 116444736000000000;  // MRPT counts 100 ns from there
    const auto microseconds = static_cast<std::int64_t>(std::llround(time * 1e6));
    return mrpt::Clock::time_point(
        mrpt::Clock::duration(from1601 + (kEpoch * 1000000 + microseconds) * 10));
}

CPose3D inSpace(const TPose2D& p) { return {p.x, p.y, 0, p.phi, 0, 0}; }

TSighting seenFrom(const TPose2D& T_w_r, const TTrueLandmark& landmark, double stamp) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double dx = landmark.centre.x() - T_w_r.x, dy = landmark.centre.y() - T_w_r.y;
    return {stamp, landmark.id,        nan,
            nan,   std::hypot(dx, dy), mrpt::math::wrapToPi(std::atan2(dy, dx) - T_w_r.phi)};
}

}  // namespace

CSimulator::CSimulator(const TWorld& description, const TSimulationOptions& options)
    : m_description(description),
      m_options(options),
      m_scenes(description),
      m_path(description.path, options.seed),
      m_people(description.people, m_path, options.seed),
      m_head(
          description.head,
          m_path,
          [this](double time) -> const CWorld& { return worldAt(time); },
          options.seed),
      m_camera(description.camera),
      m_sensor(description.camera, m_camera, options.seed),
      m_scanTimes(scanInstants()) {
    for (const CWorld* world : m_scenes.all())
        m_lasers.try_emplace(world, description.laser, *world, options.seed);
    if (!(m_options.threads >= 1))
        throw std::invalid_argument("threads = " + std::to_string(m_options.threads) +
                                    " is below 1");
}

CObservationPanTilt CSimulator::headState(double time) const {
    const THeadOptions& head = m_description.head;
    CObservationPanTilt state;
    state.sensorLabel = "HEAD";
    state.timestamp = clockTime(time);
    state.pan = m_head.pan(time);
    state.tilt = head.tilt;
    state.basePose = CPose3D(head.x, 0, head.z, 0, 0, 0);
    state.cameraOnHead = CPose3D(head.cameraForward, 0, 0, -M_PI / 2, 0, -M_PI / 2);
    return state;
}

CPose3D CSimulator::cameraPose(double time) const {
    return inSpace(truePose(time)) + headState(time).cameraPose();
}

double CSimulator::pictureTime(std::size_t index) const {
    return rounded(m_head.pictureTimes()[index]);
}

std::string CSimulator::pictureName(std::size_t index) const {
    char name[64];  // as rawlog-grabber names external pictures
    std::snprintf(name, sizeof name, "CAMERA_%.6f.jpg", stampOf(pictureStamp(index)));
    return name;
}

double CSimulator::pictureStamp(std::size_t index) const {
    const TCameraOptions& camera = m_description.camera;
    const double jitter = CRandom(m_options.seed, "latency", index).normal(camera.latencyJitter);
    return rounded(pictureTime(index) + camera.latency + jitter);
}

cv::Mat CSimulator::picture(std::size_t index) const {
    const double time = pictureTime(index);
    constexpr double h = 1e-3;
    const CPose3D before = cameraPose(time - h), after = cameraPose(time + h);
    const CPose3D moved = after - before;  // in the camera's own frame
    const Eigen::Matrix3d turn = moved.getRotationMatrix().asEigen();
    TCameraMotion motion;
    motion.linear = Eigen::Vector3d(moved.x(), moved.y(), moved.z()) / (2 * h);
    motion.angular = Eigen::Vector3d(turn(2, 1), turn(0, 2), turn(1, 0)) / (2 * h);
    CWorld world = worldAt(time);
    for (const auto& person : m_people.around(time))
        world.addPerson(person.place, m_people.options(), person.clothes);
    return m_sensor.develop(CRenderer(world, m_camera).render(cameraPose(time)), motion, index);
}

void CSimulator::writePicture(const std::filesystem::path& folder, std::size_t index) const {
    const auto file = (folder / pictureName(index)).string();
    if (!cv::imwrite(file, picture(index),
                     {cv::IMWRITE_JPEG_QUALITY, m_description.camera.jpegQuality}))
        throw std::runtime_error(file + ": cannot be written");
}

void CSimulator::writePictures(const std::filesystem::path& folder,
                               const std::function<void()>& onPicture) const {
    std::filesystem::create_directories(folder);
    inParallel(pictureCount(), m_options.threads, [&](std::size_t i) {
        writePicture(folder, i);
        if (onPicture) onPicture();
    });
}

std::vector<TSighting> CSimulator::sightingsInPicture(std::size_t index) const {
    const double time = pictureTime(index);
    const CPose3D T_w_c = cameraPose(time);
    const Eigen::Vector3d position(T_w_c.x(), T_w_c.y(), T_w_c.z());
    const Eigen::Matrix3d toCamera = T_w_c.getRotationMatrix().asEigen().transpose();
    const CWorld& world = worldAt(time);
    const auto people = m_people.around(time);
    std::vector<TSighting> seen;
    for (const auto& landmark : world.landmarks()) {
        if (landmark.kind != ETruthKind::salient) continue;
        const Eigen::Vector3d normal(std::cos(landmark.yaw), std::sin(landmark.yaw), 0);
        const auto pixel = m_camera.project(toCamera * (landmark.centre - position));
        if (!pixel || !(normal.dot(position - landmark.centre) > 0) ||
            !world.visible(position, landmark.centre) ||
            m_people.hide(people, position, landmark.centre))
            continue;
        seen.push_back(seenFrom(truePose(time), landmark, stampOf(pictureStamp(index))));
        seen.back().u = pixel->x();
        seen.back().v = pixel->y();
    }
    return seen;
}

std::vector<TSighting> CSimulator::sightingsInScan(double time) const {
    const TPose2D robot = truePose(time);
    const TLaserOptions& laser = m_description.laser;
    const Eigen::Vector3d origin(robot.x + laser.x * std::cos(robot.phi),
                                 robot.y + laser.x * std::sin(robot.phi), laser.z);
    const CWorld& world = worldAt(time);
    const auto people = m_people.around(time);
    std::vector<TSighting> seen;
    for (const auto& landmark : world.landmarks()) {
        if (landmark.kind != ETruthKind::corner) continue;
        const Eigen::Vector3d ray = landmark.centre - origin;
        const double bearing = mrpt::math::wrapToPi(std::atan2(ray.y(), ray.x()) - robot.phi);
        if (ray.norm() <= laser.maxRange() && std::abs(bearing) <= laser.apertureAngle() / 2 &&
            world.visible(origin, landmark.centre) &&
            !m_people.hide(people, origin, landmark.centre))
            seen.push_back(seenFrom(robot, landmark, stampOf(time)));
    }
    return seen;
}

std::vector<double> CSimulator::instants(double rate,
                                         double phase,
                                         double jitter,
                                         const char* purpose) const {
    CRandom random(m_options.seed, purpose, 0);
    std::vector<double> times;
    for (int i = 0;; ++i) {
        const double limit = 0.4 / rate;  // keeps them in order
        const double shift = std::clamp(random.normal(jitter), -limit, limit);
        const double time = rounded(std::max(0.0, (i + phase) / rate + shift));
        if (!(time <= m_path.duration())) return times;
        times.push_back(time);
    }
}

/// Scans are taken but while the laser is silent.
std::vector<double> CSimulator::scanInstants() const {
    const TLaserOptions& laser = m_description.laser;
    auto times = instants(laser.rate, 0.37, laser.jitter, "scan times");
    if (!(laser.silentEvery > 0)) return times;
    CRandom random(m_options.seed, "silences", 0);
    for (double from = 0; from < m_path.duration();) {
        from -= laser.silentEvery * std::log(1 - random.unit());  // exponential
        const double to = from + laser.silent;
        times.erase(std::remove_if(times.begin(), times.end(),
                                   [&](double time) { return time > from && time < to; }),
                    times.end());
        from = to;
    }
    return times;
}

void CSimulator::addPictures(Records& records) const {
    for (std::size_t i = 0; i < pictureCount(); ++i) {
        auto record = mrpt::obs::CObservationImage::Create();
        record->sensorLabel = "CAMERA";
        record->timestamp = clockTime(pictureStamp(i));
        record->cameraPose = headState(pictureTime(i)).cameraPose();
        record->cameraParams = m_camera.parameters();
        record->image.setExternalStorage(pictureName(i));
        records.push_back(record);
    }
}

void CSimulator::addScans(Records& records, std::vector<TSighting>& sightings) const {
    for (std::size_t i = 0; i < m_scanTimes.size(); ++i) {
        const double time = m_scanTimes[i];
        auto record = mrpt::obs::CObservation2DRangeScan::Create(scan(i));
        record->timestamp = clockTime(time);
        records.push_back(record);
        for (const auto& s : sightingsInScan(time)) sightings.push_back(s);
    }
}

mrpt::obs::CObservation2DRangeScan CSimulator::scan(std::size_t index) const {
    const double time = m_scanTimes.at(index);
    const CLaserModel& laser = m_lasers.at(&worldAt(time));
    const auto people = m_people.around(time);
    if (people.empty()) return laser.scan(truePose(time), index);
    CWorld crowd;
    for (const auto& person : people)
        crowd.addPerson(person.place, m_people.options(), person.clothes);
    return laser.with(crowd.segmentsAt(m_description.laser.z)).scan(truePose(time), index);
}

CSimulator::Records CSimulator::sightingsFromBank() const {
    const CBankedFrontEnd frontEnd(m_options.bank, m_options.seed);
    Records records;
    for (std::size_t i = 0; i < pictureCount(); ++i) {
        const auto record = frontEnd.look(*this, i);
        if (!record) continue;
        record->sensorLabel = "CAMERA_SALIENT";
        record->timestamp = clockTime(pictureStamp(i));
        records.push_back(record);
    }
    return records;
}

CSimulator::Records CSimulator::headStates() const {
    const THeadOptions& head = m_description.head;
    Records records;
    for (const double time : instants(head.rate, 0.11, head.jitter, "head times"))
        records.push_back(CObservationPanTilt::Create(headState(time)));
    return records;
}

void CSimulator::addOdometry(Records& records, TSimulationSummary& summary) const {
    const TOdometryOptions& options = m_description.odometry;
    COdometryModel model(options, m_options.seed);
    TPose2D start, truth, measured;
    for (const double time : instants(options.rate, 0, options.jitter, "odometry times")) {
        truth = truePose(time);
        if (summary.odometryRecords++ == 0) start = truth;
        measured = model.next(truth);
        auto record = mrpt::obs::CObservationOdometry::Create();
        record->sensorLabel = "ODOMETRY";
        record->timestamp = clockTime(time);
        record->odometry = mrpt::poses::CPose2D(measured);
        records.push_back(record);
    }
    const auto moved = mrpt::poses::CPose2D(truth) - mrpt::poses::CPose2D(start);
    summary.odometryMiss = std::hypot(moved.x() - measured.x, moved.y() - measured.y);
}

TPose2D CSimulator::wheelMotion(double from, double to, std::uint32_t draw) const {
    TOdometryOptions options = m_description.odometry;
    options.level = EOdometryNoise::medium;
    const auto seed = static_cast<std::uint32_t>(
        CRandom(m_options.seed, "wheels at pictures", draw).bits() & 0xFFFFFFFF);
    COdometryModel model(options, seed);
    TPose2D motion = model.next(truePose(from));
    for (double time = from; time < to;) {
        time = std::min(time + 1 / options.rate, to);
        motion = model.next(truePose(time));
    }
    return motion;
}

TSimulationSummary CSimulator::run(const std::filesystem::path& folder,
                                   const std::function<void()>& onPicture) {
    const auto file = [&](const std::string& ending) {
        return folder / (m_description.name() + ending);
    };
    TSimulationSummary summary;
    Records records;
    std::vector<TSighting> sightings;
    addOdometry(records, summary);
    std::vector<TTruePose> truth;
    for (const auto& r : records) {
        const double stamp = mrpt::Clock::toDouble(r->timestamp);
        truth.push_back({stamp, truePose(stamp - stampOf(0))});
    }
    addScans(records, sightings);
    summary.scans = records.size() - summary.odometryRecords;
    Records companion = headStates();
    summary.panTiltRecords = companion.size();
    if (m_options.bank) {
        const Records seen = sightingsFromBank();
        summary.salientRecords = seen.size();
        companion.insert(companion.end(), seen.begin(), seen.end());
    } else {
        addPictures(records);
        summary.pictures = pictureCount();
    }
    for (std::size_t i = 0; i < pictureCount(); ++i)
        for (const auto& s : sightingsInPicture(i)) sightings.push_back(s);
    std::stable_sort(sightings.begin(), sightings.end(),
                     [](const auto& a, const auto& b) { return a.stamp < b.stamp; });

    if (!m_options.bank && m_options.pictures) writePictures(file("_Images"), onPicture);
    writeTrajectory(file(".gt.tum"), truth);
    writeLandmarks(file(".landmarks.csv"), m_scenes.landmarks());
    writeSightings(file(".sightings.csv"), sightings);
    writeRawlog(file(".salient.rawlog"), std::move(companion));
    writeRawlog(file(".rawlog"), std::move(records));
    summary.duration = m_path.duration();
    summary.laserOffset = m_lasers.begin()->second.offset();
    return summary;
}

}  // namespace salma::simulator
