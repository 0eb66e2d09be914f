// SPDX-License-Identifier: BSD-3-Clause
#include "CPosterViews.h"

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace salma::bench {
namespace {

using appearance::CWallView;
using appearance::TWallRectangle;
using mrpt::poses::CPose3D;

constexpr double kLeastResolution = 40;  // [px/m]

double widthOf(const std::string& texture, double height) {
    const cv::Mat picture = cv::imread(texture);
    if (picture.empty()) throw std::runtime_error(texture + ": cannot be read");
    return height * picture.cols / picture.rows;
}

simulator::TCameraOptions cameraOptions() {
    simulator::TCameraOptions camera;
    camera.exposureSigma = 0.2;  // a camera that sets its exposure anew each time
    return camera;
}

simulator::TWorld worldWith(const std::string& texture,
                            const std::string& wallTexture,
                            double width,
                            double height) {
    simulator::TWorld world;
    simulator::TWall wall;
    wall.name = "north";
    wall.from = {-8, 0};
    wall.to = {8, 0};
    wall.texture = wallTexture;
    world.walls = {wall};
    simulator::TPoster poster;
    poster.name = "it";
    poster.wall = wall.name;
    poster.at = 8;
    poster.centreHeight = CPosterViews::kCentreHeight;
    poster.width = width;
    poster.height = height;
    poster.texture = texture;
    world.posters = {poster};
    world.camera = cameraOptions();
    return world;
}

CPose3D disturbed(const CPose3D& T, const TViewNoise& noise, std::mt19937& random) {
    std::normal_distribution<double> n;
    const double x = noise.extrinsicsXyz * n(random), y = noise.extrinsicsXyz * n(random);
    const double z = noise.extrinsicsXyz * n(random), a = noise.extrinsics * n(random);
    const double b = noise.extrinsics * n(random), c = noise.extrinsics * n(random);
    return CPose3D(T.x() + x, T.y() + y, T.z() + z, 0, 0, 0) + CPose3D(0, 0, 0, a, b, c) +
           CPose3D(0, 0, 0, T.yaw(), T.pitch(), T.roll());
}

laser::TLine lineAt(double rho, double alpha) {
    laser::TLine line;
    line.rho = rho;
    line.alpha = alpha;
    const double c = std::cos(alpha), s = std::sin(alpha);
    line.from = {rho * c + 8 * s, rho * s - 8 * c};
    line.to = {rho * c - 8 * s, rho * s + 8 * c};
    line.covariance << 1e-4, 0, 0, mrpt::square(mrpt::DEG2RAD(0.5));
    return line;
}

/// The whole rectangle in the picture, fine enough.
bool shows(const CWallView& view, const TWallRectangle& r) {
    for (const double u : {r.u0, (r.u0 + r.u1) / 2, r.u1})
        for (const double v : {r.v0, (r.v0 + r.v1) / 2, r.v1}) {
            const auto pixel = view.toPixel(u, v);
            if (!pixel || !view.inPicture(*pixel, 4) ||
                !(view.pixelsPerMetre(u, v) >= kLeastResolution))
                return false;
        }
    return true;
}

}  // namespace

CPosterViews::CPosterViews(const std::string& texture,
                           const std::string& wall,
                           double height,
                           std::uint32_t seed)
    : CPosterViews(worldWith(texture, wall, widthOf(texture, height), height),
                   widthOf(texture, height),
                   height,
                   seed) {}

CPosterViews::CPosterViews(const simulator::TWorld& scene,
                           double width,
                           double height,
                           std::uint32_t seed)
    : m_width(width),
      m_height(height),
      m_seed(seed),
      m_description(scene),
      m_world(m_description),
      m_camera(m_description.camera),
      m_renderer(m_world, m_camera),
      m_sensor(m_description.camera, m_camera, seed) {}

TPosterView CPosterViews::view(std::uint32_t index) const {
    std::seed_seq seed{m_seed, index};
    std::mt19937 random(seed);
    int draws = 0;
    for (;;) {
        ++draws;
        const double distance = std::uniform_real_distribution<double>(1, 6)(random);
        const double limit = mrpt::DEG2RAD(65.0);
        const double incidence = std::uniform_real_distribution<double>(-limit, limit)(random);
        std::uniform_real_distribution<double> unit(-1, 1);
        // The camera's place as the world has it, 1.2 to 1.5 m high, and where it points.
        const double z = 1.35 + 0.15 * unit(random);
        const double x = -distance * std::sin(incidence), y = -distance * std::cos(incidence);
        const double heading = M_PI_2 - incidence + mrpt::DEG2RAD(4.0) * unit(random);
        const double tilt =
            std::atan2(kCentreHeight - z, distance) + mrpt::DEG2RAD(2.0) * unit(random);
        const double pan = mrpt::DEG2RAD(60.0) * unit(random);
        const CPose3D onRobot =
            CPose3D(0.14, 0, z, pan, -tilt, 0) + CPose3D(0, 0, 0, -M_PI_2, 0, -M_PI_2);
        const double phi = heading - pan;
        const CPose3D robot(x - 0.14 * std::cos(phi), y - 0.14 * std::sin(phi), 0, phi, 0, 0);
        const double alpha = M_PI_2 - phi, rho = -robot.y();
        const CWallView truth(m_camera.parameters(), onRobot, lineAt(rho, alpha));
        const TWallRectangle place{-robot.x() - m_width / 2, kCentreHeight - m_height / 2,
                                   -robot.x() + m_width / 2, kCentreHeight + m_height / 2};
        if (!(rho > 0.3) || !shows(truth, place)) continue;
        std::normal_distribution<double> n;
        const double seenRho = rho + noise.wallRho * n(random);
        const double seenAlpha = alpha + noise.wallAngle * n(random);
        const CWallView seen(m_camera.parameters(), disturbed(onRobot, noise, random),
                             lineAt(seenRho, seenAlpha));
        TWallRectangle cut{0, 0, 0, 0};
        for (const bool right : {false, true})
            for (const bool top : {false, true}) {
                auto pixel = *truth.toPixel(right ? place.u1 : place.u0, top ? place.v1 : place.v0);
                pixel.x += noise.pixel * n(random);
                pixel.y += noise.pixel * n(random);
                const auto at = *seen.toWall(pixel);
                (right ? cut.u1 : cut.u0) += at.x / 2;
                (top ? cut.v1 : cut.v0) += at.y / 2;
            }
        for (double* side : {&cut.u0, &cut.v0, &cut.u1, &cut.v1}) *side += noise.border * n(random);
        const cv::Mat picture = m_sensor.develop(m_renderer.render(robot + onRobot), {}, index);
        cv::Mat grey;
        cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
        return {grey, truth, seen, place, cut, robot, distance, incidence, draws};
    }
}

}  // namespace salma::bench
