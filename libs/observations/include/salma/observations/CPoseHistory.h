// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/poses/CPose2D.h>

#include <optional>
#include <vector>

namespace salma::observations {

/// Odometry poses T_o_r over time, interpolated in between (position linear, heading the short
/// way).
class CPoseHistory {
 public:
    /// Stamps must not decrease; of equal stamps the last pose counts. \throw std::invalid_argument
    void add(double time, const mrpt::poses::CPose2D& pose);

    /** Pose at `time` [s]. Nothing if the history is empty or `time` is more than `maxSkew` [s]
     * before its first or after its last stamp; within that, the end pose is held. */
    std::optional<mrpt::poses::CPose2D> at(double time, double maxSkew) const;

    /// Drops what is older than `time` [s], but for the last such pose: `time` itself stays known.
    void forgetBefore(double time);

    bool empty() const { return m_times.empty(); }

 private:
    std::vector<double> m_times;
    std::vector<mrpt::poses::CPose2D> m_poses;
};

}  // namespace salma::observations
