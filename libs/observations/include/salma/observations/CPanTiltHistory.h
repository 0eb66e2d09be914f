// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/poses/CPose3D.h>
#include <salma/observations/CObservationPanTilt.h>

#include <optional>
#include <vector>

namespace salma::observations {

/// States of one pan/tilt head over time, interpolated linearly in between.
class CPanTiltHistory {
 public:
    /// Stamps must not decrease. \throw std::invalid_argument
    void add(const CObservationPanTilt::Ptr& state);

    /// T_r_c at `time` [s]; ends and gaps as in CPoseHistory::at().
    std::optional<mrpt::poses::CPose3D> cameraPose(double time, double maxSkew) const;

    /// Drops what is older than `time` [s], but for the last such state: `time` itself stays known.
    void forgetBefore(double time);

    bool empty() const { return m_states.empty(); }

 private:
    std::vector<CObservationPanTilt::Ptr> m_states;
};

}  // namespace salma::observations
