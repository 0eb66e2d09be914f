// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <TSlamConfig.h>
#include <salma/simulator/CSightingBank.h>
#include <salma/simulator/TWorld.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace salma::apps {

/** A world of a study: makes simulated logs that hold the front end's records.
 *
 * These come from pictures that are rendered for each drive, or from a bank of sightings, which is
 * quicker by far. */
class CStudyWorld {
 public:
    /// `config` must outlive this object.
    /// \throw std::invalid_argument naming file, section, key and value
    CStudyWorld(const std::filesystem::path& file, const TSlamConfig& config);

    /** From now on records come from the bank NAME.bank in `folder`, which is made in `threads`
     * threads if it is missing, with so many renderings of each picture.
     * \throw std::runtime_error, std::invalid_argument if the bank there is another
     * world's or another front end's, or the world cannot have one. */
    void useBank(const std::filesystem::path& folder, int draws, int threads);

    std::string name() const { return m_world.name(); }
    int laps() const { return m_world.path.laps; }

    /// Of all that a log is made from but noise level and seed.
    std::string hash() const;

    /** Leaves in `folder` what the front end sees on the drive of `seed`; nothing if there is a
     * bank. It is the same at every level of odometry noise, whose part in it are millimetres
     * between picture and scan. \throw std::runtime_error */
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
                                   const std::filesystem::path& folder,
                                   bool pictures) const;

    simulator::TWorld m_world;
    const TSlamConfig& m_config;
    std::shared_ptr<const simulator::CSightingBank> m_bank;
    std::string m_bankHash;
};

/// Names of the levels of odometry noise.
std::vector<std::string> noiseNames();

}  // namespace salma::apps
