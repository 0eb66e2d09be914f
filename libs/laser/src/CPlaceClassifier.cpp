// SPDX-License-Identifier: BSD-3-Clause
#include <salma/laser/CPlaceClassifier.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "placeFeatures.h"
#include "placeModel.h"

namespace salma::laser {
namespace {

Eigen::VectorXf outputs(const TPlaceNetwork& network, const Eigen::VectorXf& features) {
    Eigen::VectorXf x = features;
    for (std::size_t i = 0; i < network.layers.size(); ++i) {
        const Eigen::MatrixXf& layer = network.layers[i];
        Eigen::VectorXf y = layer.leftCols(layer.cols() - 1) * x + layer.rightCols<1>();
        if (i + 1 < network.layers.size()) y = y.cwiseMax(0.0F);
        x.swap(y);
    }
    return x;
}

}  // namespace

void TPlaceNetwork::validate() const {
    auto inputs = static_cast<Eigen::Index>(numberOfPlaceFeatures());
    for (const Eigen::MatrixXf& layer : layers) {
        if (layer.cols() != inputs + 1 || layer.rows() < 1)
            throw std::invalid_argument("place network: a layer does not fit what it is fed");
        if (!layer.allFinite())
            throw std::invalid_argument("place network: a weight is not finite");
        inputs = layer.rows();
    }
    if (layers.empty() || inputs != static_cast<Eigen::Index>(kPlaceClasses))
        throw std::invalid_argument("place network: not one output for each class");
}

TPlaceNetwork shippedPlaceNetwork() {
    TPlaceNetwork network;
    const float* next = kPlaceWeights.data();
    for (std::size_t i = 0; i + 1 < kPlaceLayers.size(); ++i) {
        const Eigen::Index rows = kPlaceLayers[i + 1], columns = kPlaceLayers[i] + 1;
        network.layers.emplace_back(Eigen::Map<const Eigen::MatrixXf>(next, rows, columns));
        next += rows * columns;
    }
    return network;
}

CPlaceClassifier::CPlaceClassifier(TPlaceNetwork network) : m_network(std::move(network)) {
    m_network.validate();
}

std::optional<TPlaceVector> CPlaceClassifier::classify(
    const mrpt::obs::CObservation2DRangeScan& scan) const {
    const auto found = features(scan);
    if (!found) return std::nullopt;
    return classify(*found);
}

TPlaceVector CPlaceClassifier::classify(const TPlaceFeatures& features) const {
    const Eigen::VectorXf seen = outputs(m_network, features.asSeen);
    const Eigen::VectorXf other = outputs(m_network, features.mirrored);
    TPlaceVector p{};
    for (std::size_t i = 0; i < kPlaceClasses; ++i) {
        const auto twin = static_cast<std::size_t>(mirrored(static_cast<EPlaceClass>(i)));
        p[i] = 0.5 * (static_cast<double>(seen[static_cast<Eigen::Index>(i)]) +
                      static_cast<double>(other[static_cast<Eigen::Index>(twin)]));
    }
    const double top = *std::max_element(p.begin(), p.end());
    double sum = 0;
    for (double& value : p) sum += value = std::exp(value - top);
    for (double& value : p) value /= sum;
    return p;
}

std::optional<TPlaceFeatures> CPlaceClassifier::features(
    const mrpt::obs::CObservation2DRangeScan& scan) {
    const auto seen = placeFeatures(scan);
    if (!seen) return std::nullopt;
    return TPlaceFeatures{*seen, mirroredFeatures(*seen)};
}

std::size_t CPlaceClassifier::numberOfFeatures() { return numberOfPlaceFeatures(); }

EPlaceClass mostLikely(const TPlaceVector& probabilities) {
    const auto top = std::max_element(probabilities.begin(), probabilities.end());
    return static_cast<EPlaceClass>(top - probabilities.begin());
}

}  // namespace salma::laser
