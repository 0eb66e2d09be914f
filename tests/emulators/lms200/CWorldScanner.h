// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/simulator/CLaserModel.h>
#include <salma/simulator/CPath.h>

#include <cstdint>
#include <memory>

#include "CSickLms200.h"

namespace salma::test {

/// The eyes of an emulated LMS 200: the simulator's laser on a robot that drives through a world.
class CWorldScanner {
 public:
    /// \param pose T_w_r at a time of the emulator's clock.
    CWorldScanner(const simulator::TWorld& description,
                  std::uint32_t seed,
                  std::function<mrpt::math::TPose2D(double now)> pose);

    /// What `scan` gives depends on the time and the number of scans before.
    std::vector<double> scan(const TLmsView& view, double now);

 private:
    simulator::TLaserOptions m_options;
    simulator::CWorld m_world;
    std::uint32_t m_seed;
    std::function<mrpt::math::TPose2D(double now)> m_pose;
    TLmsView m_view;
    std::unique_ptr<simulator::CLaserModel> m_laser;  //!< For m_view.
    std::uint64_t m_index{0};
};

}  // namespace salma::test
