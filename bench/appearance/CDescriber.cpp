// SPDX-License-Identifier: BSD-3-Clause
#include "CDescriber.h"

#include <salma/appearance/CPatchMatcher.h>

namespace salma::bench {
namespace {

constexpr std::size_t kMinKeypoints = 12;  // as [front_end] has it

}  // namespace

std::optional<observations::TPatch> CDescriber::patchOf(const TPosterView& view) const {
    auto patch = m_rectifier.rectify(view.grey, view.seen, view.cut).patch;
    if (!patch) return std::nullopt;
    patch->keypoints = m_descriptor.describe(*patch);
    patch->regions = m_secondLook.describe(view.grey, view.seen, view.cut);
    if (!appearance::saysEnough(*patch, kMinKeypoints)) return std::nullopt;
    return patch;
}

}  // namespace salma::bench
