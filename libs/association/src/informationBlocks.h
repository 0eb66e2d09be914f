// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/TMeasurement.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <vector>

namespace salma::association {

/** The DIM x DIM blocks on the diagonal of a covariance's inverse, from its Cholesky factor.
 *
 * The other blocks are not needed, and a column of L^-1 is zero above the diagonal: with both left
 * out it takes a sixth of the operations of the whole inverse. The size must be a multiple of DIM.
 */
template <int DIM>
std::vector<TReadingCovariance<DIM>> informationBlocks(const Eigen::LLT<Eigen::MatrixXd>& factor) {
    constexpr Eigen::Index columns = DIM * 16;  // at a time
    const Eigen::MatrixXd& L = factor.matrixLLT();
    std::vector<TReadingCovariance<DIM>> result;
    for (Eigen::Index begin = 0; begin < L.rows(); begin += columns) {
        const Eigen::Index rest = L.rows() - begin;
        Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(rest, std::min(columns, rest));
        L.bottomRightCorner(rest, rest).triangularView<Eigen::Lower>().solveInPlace(inverse);
        for (Eigen::Index k = 0; k < inverse.cols(); k += DIM) {
            const auto block = inverse.middleCols<DIM>(k);
            result.push_back(block.transpose() * block);
        }
    }
    return result;
}

}  // namespace salma::association
