// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/landmarks/CFrontEnd.h>
#include <salma/simulator/CSightingBank.h>
#include <salma/simulator/TWorld.h>

#include <functional>

namespace salma::simulator {

class CSimulator;

/// What a bank is made with.
struct TBankOptions {
    int draws{4};    //!< Times that each picture of the drive is rendered.
    int threads{1};  //!< The result does not depend on it.
    landmarks::TSeeingOptions seeing;
};

/** Drives through a world several times, each time with another seed of all noise, renders every
 * picture and keeps what the front end makes of it.
 *
 * A run later draws, for each of its pictures, one of the views taken from the same place
 * (CBankedFrontEnd). The picture is kept whole, not poster by poster: what else is in view decides
 * which entity the front end takes. Only worlds whose head does not follow posters can have a bank:
 * else the pictures of two seeds are not of the same places. */
class CBankBuilder {
 public:
    /// \throw std::invalid_argument if the head attends, or options are out of range.
    CBankBuilder(const TWorld& world, const TBankOptions& options);

    /// All that the views depend on, as text: world, textures, front end.
    std::string key() const;

    /// Pictures to render.
    std::size_t pictureCount() const;

    /// [draw][picture]. \param onPicture Called after each, from several threads.
    std::vector<std::vector<TBankedView>> build(const std::function<void()>& onPicture = {}) const;

    /// Seeds of runs must stay below this, which is that of the first draw.
    static constexpr std::uint32_t kFirstSeed = 1000001;

 private:
    TBankedView look(const CSimulator& drive, std::size_t picture) const;

    TWorld m_world;
    TBankOptions m_options;
    landmarks::CFrontEnd m_frontEnd;
};

}  // namespace salma::simulator
