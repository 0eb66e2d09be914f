// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/system/crc.h>
#include <salma/simulator/CBankBuilder.h>
#include <salma/simulator/CSimulator.h>

#include <Eigen/Geometry>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <stdexcept>

#include "inParallel.h"
#include "textures.h"

namespace salma::simulator {

using Eigen::Vector3d;
using observations::TPatch;

namespace {

/// As it comes back from the picture's file.
cv::Mat throughJpeg(const cv::Mat& picture, int quality) {
    std::vector<unsigned char> bytes;
    cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
    cv::Mat grey;
    cv::cvtColor(cv::imdecode(bytes, cv::IMREAD_UNCHANGED), grey, cv::COLOR_BGR2GRAY);
    return grey;
}

std::string checksumOf(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    const std::vector<std::uint8_t> bytes(std::istreambuf_iterator<char>(in), {});
    char text[16];
    std::snprintf(text, sizeof text, "%08x", mrpt::system::compute_CRC32(bytes));
    return text;
}

/// A line for each picture file that the world shows.
std::string texturesOf(const TWorld& world) {
    std::set<std::string> names{world.room.floor, world.room.ceiling};
    for (const auto& w : world.walls) names.insert(w.texture);
    for (const auto& d : world.doors) names.insert(d.texture);
    for (const auto& b : world.boxes) names.insert(b.texture);
    for (const auto& p : world.posters) names.insert(p.texture);
    std::string text;
    for (const auto& name : names)
        if (!isBuiltInTexture(name))
            text += "texture " + name + " " + checksumOf(world.file.parent_path() / name) + "\n";
    return text;
}

std::string asIni(const landmarks::TSeeingOptions& s) {
    return s.frontEnd.asIni("front_end") + s.saliency.asIni("saliency") +
           s.clustering.asIni("clustering") + s.mser.asIni("mser") + s.quad.asIni("quad") +
           s.selection.asIni("selection") + s.border.asIni("border") +
           s.rectification.asIni("rectification") + s.secondLook.asIni("second_look") +
           s.texture.asIni("texture") + s.descriptor.asIni("descriptor");
}

/// Ties a patch to the place in the world that its ray meets.
TBankedSighting tied(const CSimulator& drive, double time, const TPatch& patch) {
    const auto inWorld = mrpt::poses::CPose3D(drive.truePose(time)) + patch.pose.mean;
    const auto camera = drive.cameraPose(time);
    const Vector3d from(camera.x(), camera.y(), camera.z());
    const Vector3d ray = Vector3d(inWorld.x(), inWorld.y(), inWorld.z()) - from;
    const double distance = drive.worldAt(time).distanceTo(from, ray.normalized());
    return {patch, from + distance * ray.normalized(), ray.norm() / distance};
}

}  // namespace

CBankBuilder::CBankBuilder(const TWorld& world, const TBankOptions& options)
    : m_world(world), m_options(options), m_frontEnd(options.seeing) {
    m_world.people.count = 0;  // each run has others, and they are drawn over the views
    if (world.head.kind() == EHeadMode::attend)
        throw std::invalid_argument(
            world.file.string() +
            ": [head] mode = 'attend': the pictures of two runs are not of the same places, so "
            "there is no bank of sightings for it");
    if (!(options.draws >= 1 && options.threads >= 1))
        throw std::invalid_argument("a bank needs at least one draw and one thread");
}

std::string CBankBuilder::key() const {
    TWorld world = m_world;
    world.odometry.level = EOdometryNoise::medium;  // whatever the run's, see wallsInView()
    world.people = {};
    return "draws = " + std::to_string(m_options.draws) + "\n" + simulator::asIni(world) +
           texturesOf(world) + asIni(m_options.seeing) + laser::TLineOptions().asIni("lines");
}

std::size_t CBankBuilder::pictureCount() const {
    std::size_t count = 0;
    for (int draw = 0; draw < m_options.draws; ++draw)
        count += CSimulator(m_world, {kFirstSeed + static_cast<std::uint32_t>(draw), 1, nullptr})
                     .pictureCount();
    return count;
}

std::vector<std::vector<TBankedView>> CBankBuilder::build(
    const std::function<void()>& onPicture) const {
    std::vector<std::vector<TBankedView>> views;
    for (int draw = 0; draw < m_options.draws; ++draw) {
        const CSimulator drive(m_world,
                               {kFirstSeed + static_cast<std::uint32_t>(draw), 1, nullptr});
        views.emplace_back(drive.pictureCount());
        inParallel(drive.pictureCount(), m_options.threads, [&](std::size_t i) {
            views.back()[i] = look(drive, i);
            if (onPicture) onPicture();
        });
    }
    return views;
}

TBankedView CBankBuilder::look(const CSimulator& drive, std::size_t picture) const {
    const double time = drive.pictureTime(picture);
    TBankedView result{drive.truePose(time), drive.pan(time), {}};
    const auto walls = wallsInView(drive, picture, m_frontEnd.options().maxSkew);
    if (!walls) return result;
    landmarks::TView view;
    view.grey = throughJpeg(drive.picture(picture), m_world.camera.jpegQuality);
    view.camera = drive.camera().parameters();
    view.T_r_c = drive.cameraOnRobot(time);
    view.walls = walls->walls;
    for (const auto& patch : m_frontEnd.process(view).landmarks) {
        const auto sighting = tied(drive, time, patch);
        if (std::isfinite(sighting.centre.sum())) result.sightings.push_back(sighting);
    }
    return result;
}

}  // namespace salma::simulator
