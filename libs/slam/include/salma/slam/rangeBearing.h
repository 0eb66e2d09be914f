// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/core/bits_math.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <salma/association/TMeasurement.h>
#include <salma/config/TStrictOptions.h>

#include <vector>

namespace salma::slam {

/// Section [range_bearing] of config.ini: noise of range-bearing records that state none.
struct TRangeBearingOptions : public config::TStrictOptions<TRangeBearingOptions> {
    double sigmaRange{0.1};                   //!< [m]
    double sigmaBearing{mrpt::DEG2RAD(0.5)};  //!< [rad]
    double sigmaPitch{mrpt::DEG2RAD(0.5)};    //!< [rad]; in space only.

    void visit(config::COptionVisitor& v);
};

/** Landmarks that a range-bearing sensor saw, in the robot frame, with the record's noise and
 * identities. They have no appearance: kind corner, not convex.
 * \throw std::invalid_argument naming the sensor if a landmark has a pitch, or is not finite. */
std::vector<association::TMeasurement> measurementsOf(
    const mrpt::obs::CObservationBearingRange& record, const TRangeBearingOptions& options = {});

/** The same in space: range, yaw and pitch in the frame of the sensor. The pitch is negative above
 * the sensor, as MRPT has it.
 * \throw std::invalid_argument naming the sensor if a landmark is not finite or its pitch reaches a
 * quarter turn. */
std::vector<association::TMeasurement3D> spatialMeasurementsOf(
    const mrpt::obs::CObservationBearingRange& record, const TRangeBearingOptions& options = {});

}  // namespace salma::slam
