// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace salma::observations {

/** Checks the counts in records of MRPT before MRPT believes them.
 *
 * MRPT's readers allocate, and fill with zeros, whatever number of elements a record claims. This
 * looks at the bytes that pass by and refuses counts for which the file has not bytes enough, in
 * the records that a log for SLAM consists of: scans, bearings and ranges, frames, actions. The
 * counts in other records, and the lengths of texts, are left to MRPT. */
class CCountGuard {
 public:
    /// An object of class `name` begins; its data start at byte `start` of the content.
    void begin(std::string_view name, int version, std::uint64_t start);

    /// `bytes` were read at `position` of `size`. What is wrong with them; "" if nothing.
    std::string check(std::uint64_t position, std::string_view bytes, std::uint64_t size);

 private:
    enum class EKind { none, scan, bearings, collection, movement };
    std::uint64_t offsetOfCount() const;

    EKind m_kind{EKind::none};
    std::uint64_t m_start{0};
    bool m_ownCovariances{false};  //!< Of bearings; decides where their count stands.
};

}  // namespace salma::observations
