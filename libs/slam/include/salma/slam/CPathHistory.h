// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/slam/TViews.h>

#include <Eigen/Core>
#include <map>
#include <utility>
#include <vector>

namespace salma::slam {

/// A measurement that took part in the estimate.
struct TUsedMeasurement {
    int landmark{0};                                 //!< Id.
    Eigen::Vector2d z{0, 0};                         //!< Range [m] and bearing [rad].
    Eigen::Matrix2d R{Eigen::Matrix2d::Identity()};  //!< Its covariance.
};

/// What a step brought, and where the robot was then as is believed now.
struct TPastStep : TViews {
    double time{0};                              //!< [s since 1970]
    Eigen::Vector3d increment{0, 0, 0};          //!< (x, y, turn) in the frame of the step before.
    Eigen::Matrix3d Q{Eigen::Matrix3d::Zero()};  //!< Its covariance [m, rad].
    std::vector<TUsedMeasurement> used;
    Eigen::Vector3d pose{0, 0, 0};  //!< (x, y, heading), world [m, rad].
    double travel{0};               //!< Along the path from the start [m].
};

/** All steps of a run: what the map was made of, so that it can be made anew.
 *
 * The first pose of the robot, before its first step, is the origin of the world. */
class CPathHistory {
 public:
    /// Appends; `travel` is filled in.
    void add(TPastStep step);

    std::size_t size() const { return m_steps.size(); }
    bool empty() const { return m_steps.empty(); }
    const TPastStep& operator[](std::size_t k) const { return m_steps[k]; }
    const TPastStep& back() const { return m_steps.back(); }

    void setPose(std::size_t k, const Eigen::Vector3d& pose) { m_steps[k].pose = pose; }

    /// Landmark `gone` turns out to be `kept`.
    void rename(int gone, int kept);
    /// Forgets the measurements of a landmark.
    void erase(int landmark);

    /// By id of each landmark that was used, the first and the last step that did.
    std::map<int, std::pair<std::size_t, std::size_t>> steps() const;

 private:
    std::vector<TPastStep> m_steps;
};

}  // namespace salma::slam
