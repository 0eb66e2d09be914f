// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/simulator/CSightingBank.h>
#include <salma/simulator/TWorld.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace salma::apps {

/// The program salma-sim.
class CSimApp {
 public:
    /// \return Exit code: 0 done, 1 failed, 2 usage.
    int run(int argc, char** argv);

 private:
    /// The world file with the flags applied. \throw std::invalid_argument
    simulator::TWorld effectiveWorld() const;
    void simulate() const;
    /// The bank of --sightings, built if it is missing; null without the flag.
    std::shared_ptr<const simulator::CSightingBank> bank(const simulator::TWorld& world) const;

    std::string m_worldFile;
    std::string m_out;
    std::uint32_t m_seed{1};
    std::optional<int> m_laps;
    std::string m_odometryNoise;  //!< "" where the world file decides; so below.
    std::string m_camera;
    std::string m_pictureSize;
    std::string m_bankFile;
    int m_draws{4};
    int m_threads{1};
    bool m_printConfig{false};
};

}  // namespace salma::apps
