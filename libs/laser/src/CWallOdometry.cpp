// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/distributions.h>
#include <mrpt/math/wrap2pi.h>
#include <salma/laser/CWallOdometry.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

namespace salma::laser {
namespace {

/// Walls side by side over less than this may only touch: odometry slips [m].
constexpr double kOverlap = 0.15;

/// Distance over which two walls lie side by side, negative for a gap between them [m].
double overlap(const TLine& a, const TLine& b) {
    const auto along = [&](const mrpt::math::TPoint2D& p) {
        return -p.x * std::sin(a.alpha) + p.y * std::cos(a.alpha);
    };
    const auto [a0, a1] = std::minmax({along(a.from), along(a.to)});
    const auto [b0, b1] = std::minmax({along(b.from), along(b.to)});
    return std::min(a1, b1) - std::max(a0, b0);
}

}  // namespace

/// A wall of the reference, seen again.
struct CWallOdometry::TMatch {
    Eigen::Matrix<double, 2, 3> H;  //!< Of (rho, alpha) by the pose since the reference.
    Eigen::Vector2d innovation;
    Eigen::Matrix2d R;
    double distance2{0};
};

void TWallOdometryOptions::visit(config::COptionVisitor& v) {
    v.flag("use", use, "improve odometry by walls seen from two poses");
    v.number("min_length_m", minLength, config::moreThan(0), "shorter lines are not compared");
    v.number("gate_quantile", gateQuantile, config::insideOf(0, 1),
             "probability that a wall seen again passes the gate");
    v.number("slack_m", slack, config::atLeast(0),
             "added to the gate: odometry errs more than it states");
    v.degrees("slack_deg", slackTurn, config::between(0, 45), "the same for the turn");
    v.number("rho_sigma_m", rhoSigma, config::atLeast(0),
             "walls are not flat: added to a line's own");
    v.degrees("alpha_sigma_deg", alphaSigma, config::between(0, 45),
              "walls are not straight: added to a line's own");
    v.number("max_travel_m", maxTravel, config::moreThan(0),
             "the reference scan is renewed after this travel");
    v.degrees("max_turn_deg", maxTurn, config::between(1, 180), "or after this turn");
}

CWallOdometry::CWallOdometry(const TWallOdometryOptions& options) : m_options(options) {
    m_options.validate();
    m_gate = mrpt::math::chi2inv(m_options.gateQuantile, 2);
}

void CWallOdometry::advance(const mrpt::poses::CPosePDFGaussian& increment) { m_pose += increment; }

/// How a line differs from what it would be as a wall of the reference.
CWallOdometry::TMatch CWallOdometry::compare(const TLine& line, const TLine& wall) const {
    const double x = m_pose.mean.x(), y = m_pose.mean.y();
    const double c = std::cos(wall.alpha), s = std::sin(wall.alpha);
    const double rho = wall.rho - x * c - y * s;
    const double alpha = wall.alpha - m_pose.mean.phi();
    // Once the robot has crossed the wall's line it looks at it from the other side. The direction
    // tells which, even where the distance is too small to.
    const double sign = std::cos(line.alpha - alpha) < 0 ? -1 : 1;
    TMatch m;
    m.H << -sign * c, -sign * s, 0, 0, 0, -1;
    m.innovation = {line.rho - sign * rho,
                    mrpt::math::wrapToPi(line.alpha - alpha - (sign < 0 ? M_PI : 0))};
    Eigen::Matrix2d byWall;  // of the predicted (rho, alpha) by the wall's own
    byWall << sign, sign * (x * s - y * c), 0, 1;
    const Eigen::Matrix2d extra = Eigen::Vector2d(m_options.rhoSigma * m_options.rhoSigma,
                                                  m_options.alphaSigma * m_options.alphaSigma)
                                      .asDiagonal();
    m.R = line.covariance + extra + byWall * wall.covariance * byWall.transpose();
    return m;
}

std::vector<CWallOdometry::TMatch> CWallOdometry::match(const std::vector<TLine>& lines) const {
    const Eigen::Matrix3d P = m_pose.cov.asEigen();
    const Eigen::Matrix2d slack = Eigen::Vector2d(m_options.slack * m_options.slack,
                                                  m_options.slackTurn * m_options.slackTurn)
                                      .asDiagonal();
    std::vector<TMatch> result;
    for (const TLine& line : lines) {
        if (!(line.length() >= m_options.minLength)) continue;
        const TLine placed = transformed(line, m_pose.mean);
        std::optional<TMatch> best;
        for (const TLine& wall : m_reference) {
            // A door's leaf only touches the wall beside it where odometry has slipped.
            if (!(overlap(wall, placed) >= kOverlap)) continue;
            TMatch m = compare(line, wall);
            const Eigen::Matrix2d S = m.H * P * m.H.transpose() + m.R + slack;
            m.distance2 = m.innovation.dot(S.ldlt().solve(m.innovation));
            if (m.distance2 <= m_gate && (!best || m.distance2 < best->distance2)) best = m;
        }
        if (best) result.push_back(*best);
    }
    return result;
}

/// Kalman update of the pose; `Q`, the covariance of the last motion within it, shrinks likewise.
void CWallOdometry::update(const std::vector<TMatch>& matches, Eigen::Matrix3d& Q) {
    const auto n = static_cast<Eigen::Index>(2 * matches.size());
    Eigen::MatrixXd H(n, 3);
    Eigen::MatrixXd S = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd innovation(n);
    for (std::size_t i = 0; i < matches.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(2 * i);
        H.middleRows<2>(row) = matches[i].H;
        innovation.segment<2>(row) = matches[i].innovation;
        S.block<2, 2>(row, row) = matches[i].R;
    }
    Eigen::Matrix3d P = m_pose.cov.asEigen();
    S += H * P * H.transpose();
    const Eigen::LDLT<Eigen::MatrixXd> factor(S);
    const Eigen::Vector3d step = P * H.transpose() * factor.solve(innovation);
    P -= P * H.transpose() * factor.solve(H * P);
    Q -= Q * H.transpose() * factor.solve(H * Q);
    m_pose.mean.x_incr(step[0]);
    m_pose.mean.y_incr(step[1]);
    m_pose.mean.phi(mrpt::math::wrapToPi(m_pose.mean.phi() + step[2]));
    m_pose.cov = mrpt::math::CMatrixDouble33(Eigen::Matrix3d(0.5 * (P + P.transpose())));
}

void CWallOdometry::renew(const std::vector<TLine>& lines) {
    m_reference.clear();
    for (const TLine& line : lines)
        if (line.length() >= m_options.minLength) m_reference.push_back(line);
    m_pose = mrpt::poses::CPosePDFGaussian();
}

mrpt::poses::CPosePDFGaussian CWallOdometry::refine(const mrpt::poses::CPosePDFGaussian& increment,
                                                    const std::vector<TLine>& lines) {
    if (!m_options.use) return increment;
    const mrpt::poses::CPose2D before = m_pose.mean;
    advance(increment);
    const auto matches = match(lines);
    m_matched = matches.size();
    mrpt::poses::CPosePDFGaussian result = increment;
    if (!matches.empty()) {
        // The motion's covariance in the axes of the reference, and back again.
        const double heading = before.phi();
        Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
        turn.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(heading).toRotationMatrix();
        Eigen::Matrix3d Q = turn * increment.cov.asEigen() * turn.transpose();
        update(matches, Q);
        result.mean = m_pose.mean - before;
        Q = turn.transpose() * Q * turn;
        result.cov = mrpt::math::CMatrixDouble33(Eigen::Matrix3d(0.5 * (Q + Q.transpose())));
    }
    if (matches.size() < 2 || !(m_pose.mean.norm() <= m_options.maxTravel) ||
        !(std::abs(m_pose.mean.phi()) <= m_options.maxTurn))
        renew(lines);
    return result;
}

}  // namespace salma::laser
