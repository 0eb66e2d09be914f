// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/laser/CPlaceClassifier.h>

#include <Eigen/Core>
#include <cstdint>
#include <ostream>
#include <vector>

namespace salma::bench {

struct TTrainingOptions {
    std::vector<int> hidden{64, 32};  //!< Sizes of the layers between features and classes.
    int epochs{25};
    int batch{128};
    double rate{0.002};  //!< At the start; falls to 0 along half a cosine.
    double decay{5e-4};  //!< Of the weights, per step and unit of rate.
    double jitter{0.1};  //!< Noise on each feature, in units of its standard deviation.
    std::uint32_t seed{1};
};

/** Fits a network by the cross entropy of its classes, every class weighing the same.
 * \param features [numberOfFeatures x samples]
 * \param targets [classes x samples], what each sample's probabilities should be.
 * \param log A line every fifth epoch. One thread; the same result for the same build.
 * Source: D. Kingma and J. Ba, "Adam", ICLR 2015; decoupled decay: I. Loshchilov and F. Hutter,
 * ICLR 2019. */
laser::TPlaceNetwork trainNetwork(const Eigen::MatrixXf& features,
                                  const Eigen::MatrixXf& targets,
                                  const TTrainingOptions& options,
                                  std::ostream& log);

}  // namespace salma::bench
