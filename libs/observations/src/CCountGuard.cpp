// SPDX-License-Identifier: BSD-3-Clause
#include "CCountGuard.h"

#include <cstring>

namespace salma::observations {
namespace {

// Bytes of a serialised CPose3D and CPose2D: length of the name, name, version, numbers, end mark.
constexpr std::uint64_t kPose3D = 1 + 20 + 1 + 12 * 8 + 1;  // version 3
constexpr std::uint64_t kPose2D = 1 + 20 + 1 + 3 * 8 + 1;   // version 1
constexpr std::uint64_t kScanCount = 4 + 1 + 4 + kPose3D;
constexpr std::uint64_t kCovarianceFlag = 4 * 4 + kPose3D + 8;
constexpr std::uint64_t kParticleCount = 4 + kPose2D + 4 + 6 * 4;
constexpr std::uint32_t kMaxParticles = 100'000;  // MRPT draws them at once; the default is 300

}  // namespace

void CCountGuard::begin(std::string_view name, int version, std::uint64_t start) {
    const auto colon = name.rfind(':');
    const std::string_view plain = colon == std::string_view::npos ? name : name.substr(colon + 1);
    // Older poses have other lengths: where the count stands is then not known.
    if ((plain == "CPose3D" && version != 3) || (plain == "CPose2D" && version != 1))
        m_kind = EKind::none;
    EKind kind = EKind::none;
    if (plain == "CObservation2DRangeScan" && version >= 6) kind = EKind::scan;
    if (plain == "CObservationBearingRange" && version >= 3) kind = EKind::bearings;
    if (plain == "CActionCollection" || (plain == "CSensoryFrame" && version >= 2))
        kind = EKind::collection;
    if (plain == "CActionRobotMovement2D" && version >= 3) kind = EKind::movement;
    if (kind == EKind::none) return;  // a part of the object that is watched, such as its pose
    m_kind = kind;
    m_start = start;
    m_ownCovariances = false;
}

std::uint64_t CCountGuard::offsetOfCount() const {
    switch (m_kind) {
        case EKind::scan:
            return kScanCount;
        case EKind::bearings:
            return kCovarianceFlag + 1 + (m_ownCovariances ? 0 : 3 * 4);
        case EKind::movement:
            return kParticleCount;
        default:
            return 0;
    }
}

std::string CCountGuard::check(std::uint64_t position, std::string_view bytes, std::uint64_t size) {
    if (m_kind == EKind::none) return {};
    if (m_kind == EKind::bearings && position == m_start + kCovarianceFlag && bytes.size() == 1)
        m_ownCovariances = bytes[0] != 0;
    if (position != m_start + offsetOfCount() || bytes.size() != 4) return {};
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data(), sizeof count);
    const std::uint64_t left = size - position - bytes.size();
    // The least that an element takes in the file: a range and its validity; four numbers; a name.
    std::uint64_t limit = left / 4;
    if (m_kind == EKind::scan) limit = left / 5;
    if (m_kind == EKind::bearings) limit = left / 16;
    if (m_kind == EKind::movement) limit = kMaxParticles;
    m_kind = EKind::none;
    if (count <= limit) return {};
    return "holds a record that claims " + std::to_string(count) + " elements";
}

}  // namespace salma::observations
