// SPDX-License-Identifier: BSD-3-Clause
#include "CWorldScanner.h"

#include <limits>
#include <stdexcept>

namespace salma::test {

using namespace simulator;

CWorldScanner::CWorldScanner(const TWorld& description,
                             std::uint32_t seed,
                             std::function<mrpt::math::TPose2D(double now)> pose)
    : m_options(description.laser), m_world(description), m_seed(seed), m_pose(std::move(pose)) {}

std::vector<double> CWorldScanner::scan(const TLmsView& view, double now) {
    if (view.resolution == 25) throw std::logic_error("the simulator's laser has no 0.25 deg");
    if (!m_laser || view.aperture != m_view.aperture || view.resolution != m_view.resolution) {
        m_options.aperture = view.aperture == 180 ? EAperture::deg180 : EAperture::deg100;
        m_options.resolution = view.resolution == 50 ? EResolution::half : EResolution::one;
        m_laser = std::make_unique<CLaserModel>(m_options, m_world, m_seed);
        m_view = view;
    }
    const auto scan = m_laser->scan(m_pose(now), m_index++);
    std::vector<double> ranges;
    for (std::size_t i = 0; i < scan.getScanSize(); ++i)
        ranges.push_back(scan.getScanRangeValidity(i) ? scan.getScanRange(i)
                                                      : std::numeric_limits<double>::infinity());
    return ranges;
}

}  // namespace salma::test
