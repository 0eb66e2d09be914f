// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/association/TMeasurement.h>

#include <cmath>

namespace salma::association {

/** Inverse of the lower Cholesky factor of a small covariance: takes vectors to unit covariance.
 *
 * Eigen's solvers go through kernels for large matrices, which takes a search over hypotheses
 * several times as long as its arithmetic. */
template <int DIM>
class CWhitener {
 public:
    CWhitener() = default;

    /// \return False where the matrix is not positive definite; do not use this object then.
    bool set(const TReadingCovariance<DIM>& covariance) {
        m_root = 1;
        for (int column = 0; column < DIM; ++column) {
            double square = covariance(column, column);
            for (int k = 0; k < column; ++k) square -= m_factor(column, k) * m_factor(column, k);
            if (!(square > 0)) return false;
            const double diagonal = std::sqrt(square);
            m_root *= diagonal;
            m_factor(column, column) = diagonal;
            for (int row = column + 1; row < DIM; ++row) {
                double entry = covariance(row, column);
                for (int k = 0; k < column; ++k) entry -= m_factor(row, k) * m_factor(column, k);
                m_factor(row, column) = entry / diagonal;
            }
        }
        invert();
        return true;
    }

    /// Square root of the covariance's determinant.
    double rootOfDeterminant() const { return m_root; }
    /// L^-1 * matrix, with DIM rows.
    template <class MATRIX>
    MATRIX operator*(const MATRIX& matrix) const {
        return m_inverse * matrix;
    }
    /// L^-1 * covariance * L^-T
    TReadingCovariance<DIM> ofCovariance(const TReadingCovariance<DIM>& covariance) const {
        return m_inverse * covariance * m_inverse.transpose();
    }

 private:
    void invert() {
        for (int column = 0; column < DIM; ++column) {
            m_inverse(column, column) = 1 / m_factor(column, column);
            for (int row = column + 1; row < DIM; ++row) {
                double entry = 0;
                for (int k = column; k < row; ++k) entry -= m_factor(row, k) * m_inverse(k, column);
                m_inverse(row, column) = entry / m_factor(row, row);
            }
        }
    }

    TReadingCovariance<DIM> m_factor{TReadingCovariance<DIM>::Zero()};
    TReadingCovariance<DIM> m_inverse{TReadingCovariance<DIM>::Zero()};
    double m_root{0};
};

}  // namespace salma::association
