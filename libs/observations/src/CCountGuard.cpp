// SPDX-License-Identifier: BSD-3-Clause
#include "CCountGuard.h"

#include <cstring>

namespace salma::observations {
namespace {

// Bytes of serialised poses: length of the name, name, version, numbers, end mark.
constexpr std::uint64_t kPose3D = 1 + 20 + 1 + 12 * 8 + 1;  // version 3
constexpr std::uint64_t kPose2D = 1 + 20 + 1 + 3 * 8 + 1;   // version 1
constexpr std::uint64_t kGaussian3D = 1 + 31 + 1 + kPose3D + 21 * 8 + 1;
// Where in the data of a record its fields stand.
constexpr std::uint64_t kScanCount = 4 + 1 + 4 + kPose3D;
constexpr std::uint64_t kCovarianceFlag = 4 * 4 + kPose3D + 8;
constexpr std::uint64_t kSharedSigmas = 3 * 4;  // stand before the count if the flag is not set
constexpr std::uint64_t kParticleCount = 4 + kPose2D + 4 + 6 * 4;
constexpr std::uint64_t kVelocityCount = 4 + kGaussian3D;
constexpr std::uint64_t kNowhere = ~std::uint64_t{0};
constexpr std::uint32_t kMaxParticles = 100'000;  // MRPT draws them at once; the default is 300

std::uint32_t numberIn(std::string_view fourBytes) {
    std::uint32_t number = 0;
    std::memcpy(&number, fourBytes.data(), sizeof number);
    return number;
}

}  // namespace

void CCountGuard::begin(std::string_view name, int version, std::uint64_t start) {
    const auto colon = name.rfind(':');
    const std::string_view plain = colon == std::string_view::npos ? name : name.substr(colon + 1);
    // Older poses have other lengths: where the count stands is then not known.
    if ((plain == "CPose3D" && version != 3) || (plain == "CPose2D" && version != 1))
        m_kind = EKind::none;
    if (plain == "CObservation2DRangeScan" && version >= 6) watch(EKind::scan, start, kScanCount);
    if (plain == "CObservationBearingRange" && version >= 3)
        watch(EKind::bearings, start, kCovarianceFlag + 1 + kSharedSigmas);
    if (plain == "CActionCollection" || (plain == "CSensoryFrame" && version >= 2))
        watch(EKind::collection, start, 0);
    if (plain == "CActionRobotMovement3D") watch(EKind::movement3D, start, kVelocityCount);
    if (plain == "CMatrixD" || plain == "CMatrixF") watch(EKind::matrix, start, 4);
    if (plain == "CActionRobotMovement2D") {
        watch(EKind::movement, start, kParticleCount);
        m_density = version < 2 ? 0 : kNowhere;
    }
}

void CCountGuard::watch(EKind kind, std::uint64_t start, std::uint64_t countAt) {
    m_kind = kind;
    m_start = start;
    m_countAt = countAt;
    m_factor = 1;
    m_density = kNowhere;
}

std::string CCountGuard::check(std::uint64_t position, std::string_view bytes, std::uint64_t size) {
    if (m_kind == EKind::none) return {};
    const std::uint64_t offset = position - m_start;
    noticeField(offset, bytes);
    if (m_density != kNowhere) return checkDensity(offset, bytes);
    if (offset != m_countAt || bytes.size() != 4) return {};
    return checkCount(numberIn(bytes), size - position - bytes.size());
}

void CCountGuard::noticeField(std::uint64_t offset, std::string_view bytes) {
    if (m_kind == EKind::bearings && offset == kCovarianceFlag && bytes.size() == 1 &&
        bytes[0] != 0)
        m_countAt = kCovarianceFlag + 1;
    if (offset != 0 || bytes.size() != 4) return;
    if (m_kind == EKind::matrix) m_factor = numberIn(bytes);
    // The method of estimation; all but odometry, which is 0, state a density.
    if (m_kind == EKind::movement && m_density == kNowhere && numberIn(bytes) != 0) m_density = 4;
}

std::string CCountGuard::checkDensity(std::uint64_t offset, std::string_view bytes) const {
    const bool length = offset == m_density && bytes.size() == 1;
    const bool name = offset == m_density + 1;
    if (length && (bytes[0] & 0x80) != 0) return {};
    if (name && bytes.find("CPosePDF") != std::string_view::npos) return {};
    return length || name ? "holds a movement without a density" : "";
}

std::string CCountGuard::checkCount(std::uint32_t count, std::uint64_t left) {
    // The least that an element takes in the file: a range and its validity; four numbers; one.
    std::uint64_t limit = left / 4;
    if (m_kind == EKind::scan) limit = left / 5;
    if (m_kind == EKind::bearings) limit = left / 16;
    if (m_kind == EKind::movement) limit = kMaxParticles;
    if (m_factor * count > limit)
        return "holds a record that claims " + std::to_string(m_factor * count) + " elements";
    // Behind the flags of the velocities come the velocities themselves.
    const bool more = m_kind == EKind::movement3D && m_countAt == kVelocityCount;
    m_countAt += 4 + count;
    if (!more) m_kind = EKind::none;
    return {};
}

}  // namespace salma::observations
