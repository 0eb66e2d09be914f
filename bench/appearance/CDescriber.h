// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/appearance/CPatchDescriptor.h>
#include <salma/appearance/CRectifier.h>
#include <salma/appearance/CRegionDescriptor.h>

#include <optional>

#include "CPosterViews.h"

namespace salma::bench {

/// Makes the patch of a view as salma-slam's front end does, from the view's rectangle.
class CDescriber {
 public:
    /// Nothing if it is refused. Without texture.
    std::optional<observations::TPatch> patchOf(const TPosterView& view) const;

 private:
    appearance::CRectifier m_rectifier;
    appearance::CPatchDescriptor m_descriptor;
    appearance::CRegionDescriptor m_secondLook;
};

}  // namespace salma::bench
