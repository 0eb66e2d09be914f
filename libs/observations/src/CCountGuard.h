// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace salma::observations {

/** Checks the counts in records of MRPT before MRPT believes them.
 *
 * MRPT's readers allocate, and fill with zeros, whatever number of elements a record claims; where
 * the memory does not suffice some of them go on with a null pointer. This looks at the bytes that
 * pass by and refuses counts for which the file has not bytes enough, in the records that a log for
 * SLAM consists of: scans, bearings and ranges, frames, actions, matrices. It also refuses a
 * movement whose density is of a class that is none, for MRPT would use the null pointer that comes
 * of it. Counts in other records, and lengths of texts, are left to MRPT. */
class CCountGuard {
 public:
    /// An object of class `name` begins; its data start at byte `start` of the content.
    void begin(std::string_view name, int version, std::uint64_t start);

    /// `bytes` were read at `position` of `size`. What is wrong with them; "" if nothing.
    std::string check(std::uint64_t position, std::string_view bytes, std::uint64_t size);

 private:
    enum class EKind { none, scan, bearings, collection, movement, movement3D, matrix };
    void watch(EKind kind, std::uint64_t start, std::uint64_t countAt);
    /// Fields that stand before the count and decide where it stands or what it means.
    void noticeField(std::uint64_t offset, std::string_view bytes);
    std::string checkDensity(std::uint64_t offset, std::string_view bytes) const;
    std::string checkCount(std::uint32_t count, std::uint64_t left);

    EKind m_kind{EKind::none};
    std::uint64_t m_start{0};
    std::uint64_t m_countAt{0};  //!< Where the count stands, after m_start.
    std::uint64_t m_factor{1};   //!< Rows of a matrix, whose count is that of its columns.
    std::uint64_t m_density{0};  //!< Where a movement's density begins, after m_start.
};

}  // namespace salma::observations
