// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <salma/laser/EPlaceClass.h>

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

namespace salma::laser {

/** A small network of fully connected layers, the last with one output for each class.
 * All layers but the last are followed by max(0, x). */
struct TPlaceNetwork {
    /// Of each layer [outputs x (inputs + 1)]; the last column is added.
    std::vector<Eigen::MatrixXf> layers;

    /// \throw std::invalid_argument if the layers do not fit each other, the features or the
    /// classes, or a weight is not finite.
    void validate() const;
};

/// The network that the project ships; `place-classes train` writes it.
TPlaceNetwork shippedPlaceNetwork();

/// Features of one scan and of the same scan with left and right exchanged.
struct TPlaceFeatures {
    Eigen::VectorXf asSeen;
    Eigen::VectorXf mirrored;
};

/** The kind of place that one scan shows.
 *
 * The scan is turned so that the walls run along the axes, then described by how far the view is
 * free to both sides of the robot's way and by the nearest range in each direction; a small network
 * gives the probabilities of the classes, all equally likely before. The scan and its mirror image
 * are asked and their answers averaged, so left and right are treated alike. Const is safe from
 * several threads. Source: own; the classes are Ho's. */
class CPlaceClassifier {
 public:
    /// \throw std::invalid_argument as TPlaceNetwork::validate().
    explicit CPlaceClassifier(TPlaceNetwork network = shippedPlaceNetwork());

    /** \param scan Of a level scanner that sees a half circle or more around the robot's front.
     * \return Probabilities, their sum 1; nothing if the scan cannot be judged: the scanner is
     * tilted, sees less, or less than a quarter of its readings is valid. */
    std::optional<TPlaceVector> classify(const mrpt::obs::CObservation2DRangeScan& scan) const;

    /// The same from features.
    TPlaceVector classify(const TPlaceFeatures& features) const;

    /// Nothing under the same conditions as classify().
    static std::optional<TPlaceFeatures> features(const mrpt::obs::CObservation2DRangeScan& scan);

    static std::size_t numberOfFeatures();

 private:
    TPlaceNetwork m_network;
};

/// The class with the largest number, the first of equals.
EPlaceClass mostLikely(const TPlaceVector& probabilities);

}  // namespace salma::laser
