// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace salma::landmarks {

/** Calls visitor(section name, options) for each section of the front end, in the order of
 * config.ini. \param seeing A TSeeingOptions, const or not. */
template <class SEEING, class VISITOR>
void forEachSeeingSection(SEEING& seeing, VISITOR visitor) {
    visitor("front_end", seeing.frontEnd);
    visitor("saliency", seeing.saliency);
    visitor("clustering", seeing.clustering);
    visitor("mser", seeing.mser);
    visitor("quad", seeing.quad);
    visitor("external", seeing.external);
    visitor("selection", seeing.selection);
    visitor("border", seeing.border);
    visitor("rectification", seeing.rectification);
    visitor("second_look", seeing.secondLook);
    visitor("texture", seeing.texture);
    visitor("descriptor", seeing.descriptor);
}

}  // namespace salma::landmarks
