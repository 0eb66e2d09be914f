// SPDX-License-Identifier: BSD-3-Clause
#include "CConsistencyStudy.h"

#include <mrpt/math/wrap2pi.h>
#include <salma/slam/CSalientEKF2D.h>
#include <salma/viz/CGnuplot.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <stdexcept>

#include "CFirstEstimatesFilter.h"

namespace salma::bench {
namespace {

struct TEstimate {
    Eigen::Vector3d pose;
    Eigen::Matrix3d covariance;
};

/// The path is not estimated anew where a loop closes: this is about the filter.
slam::TMapCare filterAlone() {
    slam::TMapCare care;
    care.relocation.use = false;
    return care;
}

TEstimate estimateOf(const slam::CSalientEKF2D& filter) {
    const auto pose = filter.pose();
    return {{pose.mean.x(), pose.mean.y(), pose.mean.phi()}, pose.cov.asEigen()};
}

TEstimate estimateOf(const CFirstEstimatesFilter& filter) {
    return {filter.pose(), filter.covariance()};
}

/// Adds a run to the sums of `result`.
template <class FILTER>
void addRun(FILTER& filter, const TDrive& drive, TConsistency& result) {
    result.nees.resize(drive.steps.size(), 0);
    for (std::size_t k = 0; k < drive.steps.size(); ++k) {
        filter.process(drive.steps[k]);
        const TEstimate estimate = estimateOf(filter);
        Eigen::Vector3d error = estimate.pose - drive.truth[k];
        error[2] = mrpt::math::wrapToPi(error[2]);
        result.nees[k] += error.dot(estimate.covariance.ldlt().solve(error));
        result.positionRms += error.head<2>().squaredNorm();
    }
}

void average(std::size_t runs, const TLevelResult& level, TConsistency& result) {
    const auto steps = static_cast<double>(result.nees.size());
    const auto count = static_cast<double>(runs);
    for (double& value : result.nees) {
        value /= count;
        result.meanNees += value / steps;
        result.shareInside += (value >= level.low && value <= level.high ? 1 : 0) / steps;
    }
    result.positionRms = std::sqrt(result.positionRms / (count * steps));
}

}  // namespace

TLevelResult study(const CLoopWorld& world,
                   const TNoiseLevel& level,
                   std::size_t runs,
                   std::uint32_t seed) {
    if (runs == 0) throw std::invalid_argument("A study needs a run");
    const auto count = static_cast<double>(runs);
    const boost::math::chi_squared distribution(3 * count);
    TLevelResult result;
    result.level = level;
    result.runs = runs;
    result.low = boost::math::quantile(distribution, 0.025) / count;
    result.high = boost::math::quantile(distribution, 0.975) / count;
    result.filters.resize(2);
    result.filters[0].filter = "EKF (CSalientEKF2D)";
    result.filters[1].filter = "first-estimates Jacobians";
    for (std::size_t run = 0; run < runs; ++run) {
        const TDrive drive = world.drive(level, seed + static_cast<std::uint32_t>(run));
        slam::CSalientEKF2D ekf({}, {}, nullptr, slam::CSalientEKF2D::atFirstSight(),
                                filterAlone());
        CFirstEstimatesFilter firstEstimates;
        addRun(ekf, drive, result.filters[0]);
        addRun(firstEstimates, drive, result.filters[1]);
        result.driftAtClosure +=
            (drive.odometryAtClosure - drive.truth[drive.closure]).head<2>().squaredNorm() / count;
    }
    result.driftAtClosure = std::sqrt(result.driftAtClosure);
    for (TConsistency& filter : result.filters) average(runs, result, filter);
    return result;
}

void plotConsistency(const std::vector<TLevelResult>& levels, const std::string& file) {
    viz::CGnuplot plot(1000, 260 * static_cast<int>(levels.size()));
    plot.script()
        << "set multiplot layout " << levels.size()
        << ",1\nset grid lc rgb '#dddddd'\nset border 3\nset tics nomirror\n"
           "set key outside right center vertical samplen 2\nset ylabel 'NEES of the pose'\n";
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const TLevelResult& level = levels[i];
        const std::string name = "level" + std::to_string(i);
        std::ostream& data = plot.data(name);
        double most = level.high;
        for (std::size_t k = 0; k < level.filters[0].nees.size(); ++k) {
            data << k;
            for (const auto& filter : level.filters) {
                data << ' ' << filter.nees[k];
                most = std::max(most, filter.nees[k]);
            }
            data << '\n';
        }
        plot.endData();
        plot.script() << "set title '" << level.level.name
                      << " odometry noise: " << std::lround(10 * level.driftAtClosure) / 10.0
                      << " m drift in a lap, average of " << level.runs << " runs'\n"
                      << "set yrange [0:" << (most > 4 * level.high ? 4 * level.high : 1.15 * most)
                      << "]\n"
                      << (i + 1 == levels.size() ? "set xlabel 'step'\n" : "") << "plot "
                      << level.low << " lc rgb '#888888' dt 2 title '95 % interval', " << level.high
                      << " lc rgb '#888888' dt 2 notitle, $" << name
                      << " using 1:2 with lines lc rgb '#1f5fa8' title 'EKF', $" << name
                      << " using 1:3 with lines lc rgb '#c0392b' title 'first-estimates Jacobians'"
                      << "\n";
    }
    plot.script() << "unset multiplot\n";
    plot.run(file);
}

}  // namespace salma::bench
