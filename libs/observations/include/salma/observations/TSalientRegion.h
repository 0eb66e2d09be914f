// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace salma::observations {

/** A salient region: Ho's six numbers. Place and scale are pixels of a picture; those of a TPatch
 * are metres in its frame, y upwards.
 * Source: T. Kadir and M. Brady, "Saliency, scale and image description", IJCV 45(2), 2001. */
struct TSalientRegion {
    double x{0};  //!< Centre, column [px]; the centre of the first pixel is 0.
    double y{0};  //!< Centre, row [px].
    double s{0};  //!< Scale: radius of the disc [px].
    double H{0};  //!< Entropy of the grey levels in the disc [nat, or the detector's base].
    double W{0};  //!< Inter-scale saliency [-].
    double Y{0};  //!< Saliency, H times W.
};

}  // namespace salma::observations
