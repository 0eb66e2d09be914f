// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation.h>
#include <salma/association/TMeasurement.h>

#include <vector>

namespace salma::slam {

/** Measurements of a step on their way from a back end to the maps of its particles.
 *
 * It lives for one step and is never stored: writing it into an archive throws std::logic_error. */
class CObservationMeasurements : public mrpt::obs::CObservation {
    DEFINE_SERIALIZABLE(CObservationMeasurements, salma::slam)

 public:
    std::vector<association::TMeasurement> measurements;  //!< In the robot frame.

    void getSensorPose(mrpt::poses::CPose3D& pose) const override;
    void setSensorPose(const mrpt::poses::CPose3D& pose) override;
    void getDescriptionAsText(std::ostream& out) const override;
};

}  // namespace salma::slam
