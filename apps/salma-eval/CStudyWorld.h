// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <TSlamConfig.h>
#include <salma/simulator/TWorld.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace salma::apps {

/** A world of a study: makes simulated logs that hold the front end's records. */
class CStudyWorld {
 public:
    /// \throw std::invalid_argument naming file, section, key and value
    CStudyWorld(const std::filesystem::path& file, const TSlamConfig& config);

    std::string name() const { return m_world.name(); }
    int laps() const { return m_world.path.laps; }

    /// Of all that a log is made from but noise level and seed.
    std::string hash() const;

    /** Leaves in `folder` what the front end sees on the drive of `seed`. It is the same at every
     * level of odometry noise, whose part in it are millimetres between picture and scan.
     * \throw std::runtime_error */
    void makeRecords(std::uint32_t seed, const std::filesystem::path& folder) const;

    /** Leaves NAME.rawlog in `folder`, its companion with these records, and the truth.
     * \param records Folder of makeRecords() of the same seed. \throw std::runtime_error */
    void makeLog(std::uint32_t seed,
                 const std::string& noise,
                 const std::filesystem::path& records,
                 const std::filesystem::path& folder) const;

 private:
    std::filesystem::path simulate(std::uint32_t seed,
                                   const std::string& noise,
                                   const std::filesystem::path& folder) const;

    simulator::TWorld m_world;
    const TSlamConfig& m_config;
};

/// Names of the levels of odometry noise.
std::vector<std::string> noiseNames();

}  // namespace salma::apps
