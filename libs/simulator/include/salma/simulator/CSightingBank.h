// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>
#include <salma/observations/TPatch.h>

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace salma::simulator {

/// What the front end made of one thing in a rendered picture.
struct TBankedSighting {
    observations::TPatch patch;
    Eigen::Vector3d centre{0, 0, 0};  //!< Where the ray to the patch's centre meets the world [m].
    double stretch{1};  //!< Distance of the patch by the laser's wall over that of `centre` [-].
};

/// One picture of the bank: what came of it, which may be nothing.
struct TBankedView {
    mrpt::math::TPose2D T_w_r;  //!< The robot's true pose at the picture [m, rad].
    double pan{0};              //!< Of the head [rad].
    std::vector<TBankedSighting> sightings;
};

/** A file of front-end results, one for each picture of a drive, drawn several times with another
 * seed of all noise.
 *
 * The file is one block: a mark, the key, an index, and each view with a checksum. It is read
 * whole, but a view is only unpacked when asked for. Const is safe from several threads. */
class CSightingBank {
 public:
    /// Reads `file`. \throw std::runtime_error naming the file if it is missing, truncated, broken
    /// or not a bank.
    explicit CSightingBank(const std::filesystem::path& file);

    /** Writes a bank, beside `file` first and then moved into place.
     * \param key What the views depend on, as text. \param views [draw][picture].
     * \throw std::runtime_error naming the file if it cannot be written. */
    static void write(const std::filesystem::path& file,
                      const std::string& key,
                      const std::vector<std::vector<TBankedView>>& views);

    const std::string& key() const { return m_key; }
    std::size_t draws() const { return m_index.size(); }
    /// Pictures of one draw; the last of a drive may be missing in some.
    std::size_t pictures(std::size_t draw) const { return m_index.at(draw).size(); }

    /// \throw std::out_of_range, or std::runtime_error if the view's bytes are broken.
    TBankedView view(std::size_t draw, std::size_t picture) const;

    /// Refuses a bank of something else. \throw std::invalid_argument naming the file and the first
    /// line that differs.
    void requireKey(const std::string& key) const;

 private:
    struct TPlace {
        std::size_t start{0}, size{0};
        std::uint32_t checksum{0};
    };
    [[noreturn]] void fail(const std::string& problem) const;
    void readHead();

    std::filesystem::path m_file;
    std::vector<std::uint8_t> m_bytes;
    std::string m_key;
    std::vector<std::vector<TPlace>> m_index;  //!< [draw][picture]
};

}  // namespace salma::simulator
