// SPDX-License-Identifier: BSD-3-Clause
#include "TPlaceSample.h"

#include <mrpt/math/wrap2pi.h>
#include <salma/simulator/CLaserModel.h>

#include <array>
#include <cmath>
#include <random>

namespace salma::bench {
namespace {

using mrpt::math::TPose2D;
using simulator::TArea;

constexpr double kFromWalls = 0.55;  // poses keep this distance from walls [m]
constexpr double kFromThings = 0.3;  // and this from everything [m]
constexpr double kTurn = M_PI / 9;   // from an axis of the building
constexpr int kTries = 4000;

class CDraw {
 public:
    explicit CDraw(std::uint32_t seed) : m_engine(seed) {}
    double uniform(double low, double high) {
        return low + (high - low) * static_cast<double>(m_engine() >> 11) * 0x1p-53;
    }
    std::size_t pick(std::size_t count) { return m_engine() % count; }
    TPose2D poseIn(const TArea& a) {
        const double turns = static_cast<double>(pick(4));
        return {uniform(a.x0 + kFromWalls, a.x1 - kFromWalls),
                uniform(a.y0 + kFromWalls, a.y1 - kFromWalls),
                turns * M_PI / 2 + uniform(-kTurn, kTurn)};
    }

 private:
    std::mt19937_64 m_engine;
};

/// A wandering robot goes on or turns on the spot.
laser::EPlaceStep stepBetween(const TPose2D& a, const TPose2D& b) {
    constexpr double kLeast = M_PI / 36;
    const bool turns = std::abs(mrpt::math::wrapToPi(b.phi - a.phi)) > kLeast;
    return turns ? laser::EPlaceStep::turning : laser::EPlaceStep::goingOn;
}

}  // namespace

simulator::TBuildingOptions trainingBuildings() {
    simulator::TBuildingOptions o;
    o.corridorWidth = {1.5, 2.9};
    o.corridorLength = {7, 22};
    o.roomSize = {4.5, 8};
    o.doorWidth = {0.75, 0.95};
    o.openShare = 0.45;
    o.clutterPerMetre = 0.1;
    return o;
}

simulator::TBuildingOptions validationBuildings() {
    simulator::TBuildingOptions o;
    o.corridorWidth = {1.45, 3.0};
    o.corridorLength = {6.5, 25};
    o.roomSize = {4.2, 8.5};
    o.doorWidth = {0.75, 1.0};
    o.openShare = 0.5;
    o.clutterPerMetre = 0.11;
    o.clutterPerRoom = 5;
    return o;
}

simulator::TBuildingOptions testBuildings() {
    simulator::TBuildingOptions o;
    o.corridorWidth = {1.4, 3.1};
    o.corridorLength = {6, 28};
    o.roomSize = {4, 9};
    o.doorWidth = {0.75, 1.05};
    o.openShare = 0.5;
    o.clutterPerMetre = 0.12;
    o.clutterPerRoom = 5;
    return o;
}

simulator::TLaserOptions placeLaser() {
    simulator::TLaserOptions options;
    options.resolution = simulator::EResolution::one;
    options.x = 0;
    return options;
}

std::vector<TPlaceSample> drawSamples(const simulator::TBuildingOptions& options,
                                      std::uint32_t seed,
                                      std::size_t most) {
    const simulator::CBuilding building(options, seed);
    const simulator::CLaserModel laser(placeLaser(), building.segments(), seed);
    CDraw draw(seed);
    std::array<std::size_t, laser::kPlaceClasses> ofClass{};
    std::array<std::size_t, simulator::kPlaceDoubts> ofDoubt{};
    std::vector<TPlaceSample> samples;
    for (int i = 0; i < kTries; ++i) {
        const bool inRoom = draw.pick(4) == 0 && !building.rooms().empty();
        const TPose2D pose =
            inRoom ? draw.poseIn(building.rooms()[draw.pick(building.rooms().size())])
                   : draw.poseIn(building.corridors()[draw.pick(building.corridors().size())].area);
        const auto truth = placeAt(building, pose);
        std::size_t& count = truth.place ? ofClass[static_cast<std::size_t>(*truth.place)]
                                         : ofDoubt[static_cast<std::size_t>(truth.doubt)];
        if (count >= most || building.clearance({pose.x, pose.y}) < kFromThings) continue;
        ++count;
        samples.push_back({laser.scan(pose, static_cast<std::uint64_t>(i)), truth, seed, {}});
    }
    return samples;
}

std::vector<TPlaceSample> drawWalk(const simulator::TBuildingOptions& options,
                                   std::uint32_t seed,
                                   std::size_t steps) {
    const simulator::CBuilding building(options, seed);
    const simulator::CLaserModel laser(placeLaser(), building.segments(), seed);
    std::vector<TPlaceSample> samples;
    const auto poses = wander(building, seed, steps);
    for (std::size_t i = 0; i < poses.size(); ++i)
        samples.push_back({laser.scan(poses[i], i), placeAt(building, poses[i]), seed,
                           stepBetween(poses[i - (i > 0 ? 1 : 0)], poses[i])});
    return samples;
}

std::vector<TPlaceStep> stepsOfWalk(const simulator::TBuildingOptions& options,
                                    std::uint32_t seed,
                                    std::size_t steps) {
    const simulator::CBuilding building(options, seed);
    const auto poses = wander(building, seed, steps);
    std::vector<TPlaceStep> result;
    std::optional<laser::EPlaceClass> last;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const auto now = placeAt(building, poses[i]).place;
        const auto next = now ? now : last;
        if (last) result.push_back({*last, *next, stepBetween(poses[i - 1], poses[i])});
        last = next;
    }
    return result;
}

}  // namespace salma::bench
