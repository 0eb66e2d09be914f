// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/poses/CPosePDFGaussian.h>
#include <salma/config/TStrictOptions.h>
#include <salma/laser/TLine.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace salma::laser {

/// Section [wall_odometry] of config.ini.
struct TWallOdometryOptions : public config::TStrictOptions<TWallOdometryOptions> {
    bool use{true};                 //!< Off: odometry stays as it is.
    double minLength{0.6};          //!< Shorter lines are not compared [m].
    double gateQuantile{0.99};      //!< Probability that a wall seen again passes the gate.
    double slack{0.04};             //!< Added to the gate: odometry errs more than it states [m].
    double slackTurn{M_PI / 30};    //!< The same for the turn [rad].
    double rhoSigma{0.01};          //!< Added to a line's own sigma: walls are not flat [m].
    double alphaSigma{M_PI / 900};  //!< Added to a line's own sigma: walls are not straight [rad].
    double maxTravel{3};            //!< The reference scan is renewed after this travel [m] ...
    double maxTurn{M_PI / 3};       //!< ... or this turn [rad].

    void visit(config::COptionVisitor& v);
};

/** Improves odometry by the walls that a scan shares with an earlier one.
 *
 * A wall seen from two poses tells the turn between them and the motion square to it; along a
 * corridor odometry keeps its word, for nothing there says more. The reference scan stays as long
 * as its walls are seen, so that errors do not add up from scan to scan. One Kalman update per scan
 * on the pose since the reference, linear in it:
 * rho' = rho - x cos(alpha) - y sin(alpha), alpha' = alpha - heading.
 * Source: own; line model as in G. Borges and M. Aldon, J. Intell. Robotic Syst. 40, 2004. */
class CWallOdometry {
 public:
    /// \throw std::invalid_argument if the options are out of range.
    explicit CWallOdometry(const TWallOdometryOptions& options = {});

    /// Tells of a motion without a scan.
    void advance(const mrpt::poses::CPosePDFGaussian& increment);

    /** \param increment Motion since the last call, robot frame before it.
     * \param lines Of the scan after the motion, robot frame.
     * \return The motion as odometry and walls together tell it. Its covariance takes the walls'
     * errors of successive calls for independent, which overstates the drift. */
    mrpt::poses::CPosePDFGaussian refine(const mrpt::poses::CPosePDFGaussian& increment,
                                         const std::vector<TLine>& lines);

    std::size_t matched() const { return m_matched; }  //!< Walls used by the last refine().

 private:
    struct TMatch;
    TMatch compare(const TLine& line, const TLine& wall) const;
    std::vector<TMatch> match(const std::vector<TLine>& lines) const;
    void update(const std::vector<TMatch>& matches, Eigen::Matrix3d& incrementCovariance);
    void renew(const std::vector<TLine>& lines);

    TWallOdometryOptions m_options;
    double m_gate{0};                      //!< Limit of the squared Mahalanobis distance.
    std::vector<TLine> m_reference;        //!< Walls of the reference scan, in its frame.
    mrpt::poses::CPosePDFGaussian m_pose;  //!< T_ref_r.
    std::size_t m_matched{0};
};

}  // namespace salma::laser
