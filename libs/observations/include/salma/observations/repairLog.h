// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace salma::observations {

/// What was kept of a broken rawlog.
struct TRepair {
    bool whole{false};                 //!< Nothing was wrong, and nothing was written.
    std::string cause;                 //!< "it breaks off", or what is damaged.
    std::size_t records{0};            //!< Objects of the file that were kept.
    double lastGoodTime{0};            //!< [s since 1970] of the last one that has a stamp.
    std::uint64_t bytesKept{0};        //!< Unpacked.
    std::uint64_t bytesLost{0};        //!< Unpacked, of a record that is not whole, and behind it.
    std::uint64_t packedBytesLost{0};  //!< Of the file, from a damaged place on.
    /** [s] from the last good time to the time at which the file was last written: so much of the
     * robot's time may be missing. Nothing where the two do not go together, as in a copy. */
    std::optional<double> secondsLost;
};

/** Keeps the whole objects at the beginning of a rawlog whose writer was killed, or whose end is
 * damaged, byte for byte, and drops the rest. The result is gzip.
 *
 * \param target Appears whole or not at all; an existing file is replaced. May be `file`, which is
 * then kept as `file`.broken.
 * \throw std::runtime_error naming the file: missing, in use by a running capture, without a whole
 * record, not a rawlog, or with a class that is not registered; also if the target, or FILE.broken
 * where it stands already, is in the way. */
TRepair repairLog(const std::string& file, const std::string& target);

}  // namespace salma::observations
