// SPDX-License-Identifier: BSD-3-Clause
#include "trainNetwork.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace salma::bench {
namespace {

using Eigen::ArrayXf;
using Eigen::MatrixXf;
using Eigen::VectorXf;

/// Adam's state of one layer; the last column of a layer is its bias.
struct TLayerState {
    MatrixXf first, second;
};

class CTrainer {
 public:
    CTrainer(const MatrixXf& features, const MatrixXf& targets, const TTrainingOptions& options)
        : m_options(options), m_features(features), m_targets(targets), m_random(options.seed) {
        // every class weighs the same, however many samples it has
        const VectorXf counts = targets.rowwise().sum().cwiseMax(1.0F);
        m_weight = counts.cwiseInverse() * (targets.sum() / static_cast<float>(targets.rows()));
        int inputs = static_cast<int>(features.rows());
        std::vector<int> sizes = options.hidden;
        sizes.push_back(static_cast<int>(targets.rows()));
        for (const int outputs : sizes) {
            addLayer(inputs, outputs);
            inputs = outputs;
        }
        m_order.resize(static_cast<std::size_t>(features.cols()));
        std::iota(m_order.begin(), m_order.end(), 0);
        m_steps = options.epochs * batches();
    }

    /// \return Mean loss.
    double epoch() {
        std::shuffle(m_order.begin(), m_order.end(), m_random);
        double loss = 0;
        for (int b = 0; b < batches(); ++b) loss += step(b * m_options.batch);
        return loss / (batches() * m_options.batch);
    }

    const std::vector<MatrixXf>& layers() const { return m_layers; }

 private:
    int batches() const { return static_cast<int>(m_order.size()) / m_options.batch; }

    void addLayer(int inputs, int outputs) {
        std::normal_distribution<float> normal(0, std::sqrt(2.0F / static_cast<float>(inputs)));
        MatrixXf layer =
            MatrixXf::NullaryExpr(outputs, inputs + 1, [&] { return normal(m_random); });
        layer.rightCols<1>().setZero();
        m_states.push_back(
            {MatrixXf::Zero(outputs, inputs + 1), MatrixXf::Zero(outputs, inputs + 1)});
        m_layers.push_back(layer);
    }

    double step(int from) {
        ++m_step;
        std::vector<MatrixXf> values{batchFrom(from)};
        for (std::size_t i = 0; i < m_layers.size(); ++i) {
            const MatrixXf& layer = m_layers[i];
            MatrixXf next = (layer.leftCols(layer.cols() - 1) * values[i]).colwise() +
                            layer.rightCols<1>().col(0);
            if (i + 1 < m_layers.size()) next = next.cwiseMax(0.0F);
            values.push_back(std::move(next));
        }
        double loss = 0;
        MatrixXf slope = errorOf(values.back(), from, loss);
        for (std::size_t i = m_layers.size(); i-- > 0;) {
            MatrixXf gradient(m_layers[i].rows(), m_layers[i].cols());
            gradient.leftCols(gradient.cols() - 1) = slope * values[i].transpose();
            gradient.rightCols<1>() = slope.rowwise().sum();
            if (i > 0) {
                const auto weights = m_layers[i].leftCols(m_layers[i].cols() - 1);
                slope = (weights.transpose() * slope).eval();
                slope.array() *= (values[i].array() > 0).cast<float>();
            }
            descend(i, gradient);
        }
        return loss;
    }

    MatrixXf batchFrom(int from) {
        std::uniform_real_distribution<float> jitter(-static_cast<float>(m_options.jitter),
                                                     static_cast<float>(m_options.jitter));
        MatrixXf batch(m_features.rows(), m_options.batch);
        for (int k = 0; k < m_options.batch; ++k)
            batch.col(k) = m_features.col(m_order[static_cast<std::size_t>(from + k)]);
        return batch.unaryExpr([&](float x) { return x + jitter(m_random); });
    }

    /// Derivative of the batch's loss by the outputs.
    MatrixXf errorOf(const MatrixXf& outputs, int from, double& loss) const {
        MatrixXf error(outputs.rows(), outputs.cols());
        for (int k = 0; k < m_options.batch; ++k) {
            const auto target = m_targets.col(m_order[static_cast<std::size_t>(from + k)]);
            ArrayXf p = (outputs.col(k).array() - outputs.col(k).maxCoeff()).exp();
            p /= p.sum();
            const float weight = m_weight.dot(target);
            loss -= static_cast<double>((target.array() * p.max(1e-9F).log()).sum());
            error.col(k) = (p - target.array()) * (weight / static_cast<float>(m_options.batch));
        }
        return error;
    }

    void descend(std::size_t i, const MatrixXf& gradient) {
        constexpr float kFirst = 0.9F, kSecond = 0.999F;
        const double done = static_cast<double>(m_step) / m_steps;
        const auto rate = static_cast<float>(m_options.rate * 0.5 * (1 + std::cos(M_PI * done)));
        TLayerState& s = m_states[i];
        s.first = kFirst * s.first + (1 - kFirst) * gradient;
        s.second = kSecond * s.second + (1 - kSecond) * gradient.cwiseAbs2();
        const auto t = static_cast<float>(m_step);
        const float c1 = 1 - std::pow(kFirst, t), c2 = 1 - std::pow(kSecond, t);
        MatrixXf& layer = m_layers[i];
        layer.leftCols(layer.cols() - 1) *= 1 - rate * static_cast<float>(m_options.decay);
        layer.array() -= rate * (s.first.array() / c1) / ((s.second.array() / c2).sqrt() + 1e-8F);
    }

    const TTrainingOptions& m_options;
    const MatrixXf& m_features;
    const MatrixXf& m_targets;
    std::mt19937 m_random;
    VectorXf m_weight;
    std::vector<int> m_order;
    std::vector<MatrixXf> m_layers;
    std::vector<TLayerState> m_states;
    int m_step{0}, m_steps{0};
};

}  // namespace

laser::TPlaceNetwork trainNetwork(const MatrixXf& features,
                                  const MatrixXf& targets,
                                  const TTrainingOptions& options,
                                  std::ostream& log) {
    constexpr float kFloor = 1e-3F;  // a feature that never changes is not blown up
    const VectorXf mean = features.rowwise().mean();
    const MatrixXf centred = features.colwise() - mean;
    const VectorXf scale =
        (centred.cwiseAbs2().rowwise().mean().cwiseSqrt().array() + kFloor).inverse();
    const MatrixXf standard = scale.asDiagonal() * centred;
    CTrainer trainer(standard, targets, options);
    for (int e = 1; e <= options.epochs; ++e) {
        const double loss = trainer.epoch();
        if (e % 5 == 0) log << "epoch " << e << " loss " << loss << std::endl;
    }
    laser::TPlaceNetwork network{trainer.layers()};
    // the first layer takes the features as they are
    MatrixXf& layer = network.layers.front();
    const Eigen::Index n = layer.cols() - 1;
    layer.leftCols(n) = (layer.leftCols(n) * scale.asDiagonal()).eval();
    layer.col(n) -= layer.leftCols(n) * mean;
    return network;
}

}  // namespace salma::bench
