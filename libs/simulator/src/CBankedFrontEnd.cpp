// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>
#include <salma/simulator/CBankedFrontEnd.h>
#include <salma/simulator/CSimulator.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "seeds.h"

namespace salma::simulator {

using appearance::CWallView;
using Eigen::Vector3d;
using observations::CObservationSalientLandmarks;
using observations::TPatch;

namespace {

constexpr double kNear = 0.3;               // from a banked view's place to a run's [m]
const double kTurned = mrpt::DEG2RAD(8.0);  // and from its viewing direction [rad]
constexpr double kSameWall = 0.3;           // from the true wall to the laser's line [m]

Vector3d position(const mrpt::poses::CPose3D& pose) { return {pose.x(), pose.y(), pose.z()}; }

/// The patch as it would be had the wall stood `factor` times as far away.
TPatch stretched(TPatch patch, double factor) {
    patch.width *= factor;
    patch.height *= factor;
    patch.pixelsPerMetre /= factor;
    for (auto& k : patch.keypoints) {
        k.x *= factor;
        k.y *= factor;
        k.scale *= factor;
    }
    for (auto& r : patch.regions) {
        r.x *= factor;
        r.y *= factor;
        r.s *= factor;
    }
    return patch;
}

/// True if somebody hides part of what the patch shows.
bool isHidden(const CSimulator& drive, double time, const TBankedSighting& sighting) {
    const auto people = drive.people().around(time);
    const auto camera = drive.cameraPose(time);
    const double yaw = drive.truePose(time).phi + sighting.patch.pose.mean.yaw();
    const Vector3d along(std::cos(yaw), std::sin(yaw), 0);
    for (const double u : {-0.5, 0.0, 0.5})
        for (const double v : {-0.5, 0.0, 0.5}) {
            const Vector3d point = sighting.centre + u * sighting.patch.width * along +
                                   v * sighting.patch.height * Vector3d::UnitZ();
            if (drive.people().hide(people, position(camera), point)) return true;
        }
    return false;
}

/// Where a ray meets a wall, in the wall's coordinates.
struct TMeeting {
    const laser::TLine* wall;
    double u, v;      // [m]
    double distance;  // along the ray [m]
};

/// Cuts the ray from `from` through `target` with the wall; nothing if it passes the wall's ends by
/// more than `margin`, or meets it far from the target.
std::optional<TMeeting> meet(const laser::TLine& wall,
                             const Vector3d& from,
                             const Vector3d& target,
                             double margin) {
    const Vector3d normal(std::cos(wall.alpha), std::sin(wall.alpha), 0);
    const Vector3d along(normal.y(), -normal.x(), 0);
    const Vector3d ray = (target - from).normalized();
    const double towards = normal.dot(ray);
    if (!(towards > 1e-6)) return std::nullopt;  // from behind, or along it
    const double distance = (wall.rho - normal.dot(from)) / towards;
    const Vector3d hit = from + distance * ray;
    const auto uOf = [&](const mrpt::math::TPoint2D& p) {
        return p.x * along.x() + p.y * along.y();
    };
    const double u = hit.dot(along);
    const auto [low, high] = std::minmax({uOf(wall.from), uOf(wall.to)});
    if (!(distance > 0 && u > low - margin && u < high + margin &&
          (hit - target).norm() < kSameWall))
        return std::nullopt;
    return TMeeting{&wall, u, hit.z(), distance};
}

}  // namespace

std::optional<TWallsInView> wallsInView(const CSimulator& drive,
                                        std::size_t index,
                                        double maxSkew) {
    const double time = drive.pictureTime(index);
    const auto& times = drive.scanTimes();
    const auto nearest = std::min_element(times.begin(), times.end(), [time](double a, double b) {
        return std::abs(a - time) < std::abs(b - time);
    });
    if (nearest == times.end() || !(std::abs(*nearest - time) <= maxSkew)) return std::nullopt;
    TWallsInView seen;
    seen.scan = drive.scan(static_cast<std::size_t>(nearest - times.begin()));
    seen.lines = laser::CLineExtractor().extract(seen.scan);
    const mrpt::poses::CPose2D between(drive.wheelMotion(
        std::min(time, *nearest), std::max(time, *nearest), static_cast<std::uint32_t>(index)));
    const auto T_picture_scan = time < *nearest ? between : mrpt::poses::CPose2D() - between;
    for (const auto& line : seen.lines.lines)
        seen.walls.push_back(transformed(line, T_picture_scan));
    return seen;
}

CBankedFrontEnd::CBankedFrontEnd(std::shared_ptr<const CSightingBank> bank, std::uint32_t seed)
    : m_bank(std::move(bank)), m_seed(seed) {}

TBankedView CBankedFrontEnd::drawn(const CSimulator& drive, std::size_t index) const {
    const double time = drive.pictureTime(index);
    const auto robot = drive.truePose(time);
    CRandom random(m_seed, "draw from bank", index);
    const std::size_t first = random.bits() % m_bank->draws();
    for (std::size_t i = 0; i < m_bank->draws(); ++i) {
        const std::size_t draw = (first + i) % m_bank->draws();
        if (index >= m_bank->pictures(draw)) continue;
        TBankedView view = m_bank->view(draw, index);
        const double turned = view.T_w_r.phi + view.pan - robot.phi - drive.pan(time);
        if (std::hypot(view.T_w_r.x - robot.x, view.T_w_r.y - robot.y) < kNear &&
            std::abs(mrpt::math::wrapToPi(turned)) < kTurned)
            return view;
    }
    throw std::runtime_error("the bank holds no view from near picture " + std::to_string(index));
}

CObservationSalientLandmarks::Ptr CBankedFrontEnd::look(const CSimulator& drive,
                                                        std::size_t index) const {
    const double time = drive.pictureTime(index);
    const auto seen = wallsInView(drive, index, m_frontEnd.options().maxSkew);
    if (!seen) return nullptr;
    auto record = CObservationSalientLandmarks::Create();
    record->cameraPose = drive.cameraOnRobot(time);
    record->camera = drive.camera().parameters();
    record->placeString = m_placeString.describe(seen->scan, seen->lines);
    for (const auto& sighting : drawn(drive, index).sightings)
        if (auto patch = moved(drive, time, sighting, seen->walls))
            record->landmarks.push_back(std::move(*patch));
    return record;
}

std::optional<TPatch> CBankedFrontEnd::moved(const CSimulator& drive,
                                             double time,
                                             const TBankedSighting& sighting,
                                             const std::vector<laser::TLine>& walls) const {
    const auto T_r_c = drive.cameraOnRobot(time);
    const auto T_w_r = mrpt::poses::CPose3D(drive.truePose(time));
    const Vector3d from = position(T_r_c);
    const Vector3d target =
        T_w_r.getRotationMatrix().asEigen().transpose() * (sighting.centre - position(T_w_r));
    std::optional<TMeeting> best;
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& wall : walls) {
        const auto here = meet(wall, from, target, m_margin);
        if (!here) continue;
        const double miss = std::abs(here->distance - (target - from).norm());
        if (miss < nearest) {
            nearest = miss;
            best = here;
        }
    }
    if (!best || isHidden(drive, time, sighting)) return std::nullopt;
    const CWallView view(drive.camera().parameters(), T_r_c, *best->wall);
    if (!view.toPixel(best->u, best->v)) return std::nullopt;
    TPatch patch =
        stretched(sighting.patch, best->distance / (target - from).norm() / sighting.stretch);
    patch.pose = m_frontEnd.poseOnWall(view, best->u, best->v);
    patch.incidence = view.incidence(best->u, best->v);
    const double w = patch.width / 2, h = patch.height / 2;
    const double du[] = {-w, w, w, -w}, dv[] = {h, h, -h, -h};
    for (std::size_t i = 0; i < 4; ++i)
        if (const auto pixel = view.toPixel(best->u + du[i], best->v + dv[i]))
            patch.quad[i] = *pixel;
    return patch;
}

}  // namespace salma::simulator
