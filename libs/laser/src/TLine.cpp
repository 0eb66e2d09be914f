// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/laser/TLine.h>

#include <cmath>

namespace salma::laser {

TLine transformed(const TLine& line, const mrpt::poses::CPose2D& T_a_b) {
    TLine out = line;
    double alpha = line.alpha + T_a_b.phi();
    const double c = std::cos(alpha);
    const double s = std::sin(alpha);
    double rho = line.rho + T_a_b.x() * c + T_a_b.y() * s;
    Eigen::Matrix2d J;  // of (rho, alpha) in a with respect to (rho, alpha) in b
    J << 1, T_a_b.y() * c - T_a_b.x() * s, 0, 1;
    if (rho < 0) {  // a's origin lies on the other side
        rho = -rho;
        alpha += M_PI;
        J.row(0) *= -1;
    }
    out.rho = rho;
    out.alpha = mrpt::math::wrapToPi(alpha);
    out.covariance = J * line.covariance * J.transpose();
    T_a_b.composePoint(line.from.x, line.from.y, out.from.x, out.from.y);
    T_a_b.composePoint(line.to.x, line.to.y, out.to.x, out.to.y);
    return out;
}

}  // namespace salma::laser
