// SPDX-License-Identifier: BSD-3-Clause
#include "CObservationMeasurements.h"

#include <ostream>
#include <stdexcept>

namespace salma::slam {

IMPLEMENTS_SERIALIZABLE(CObservationMeasurements, mrpt::obs::CObservation, salma::slam)

std::uint8_t CObservationMeasurements::serializeGetVersion() const { return 0; }

void CObservationMeasurements::serializeTo(mrpt::serialization::CArchive& /*out*/) const {
    throw std::logic_error("The measurements of a step are not stored");
}

void CObservationMeasurements::serializeFrom(mrpt::serialization::CArchive& /*in*/,
                                             std::uint8_t /*version*/) {
    throw std::logic_error("The measurements of a step are not stored");
}

void CObservationMeasurements::getSensorPose(mrpt::poses::CPose3D& pose) const { pose = {}; }

void CObservationMeasurements::setSensorPose(const mrpt::poses::CPose3D& /*pose*/) {}

void CObservationMeasurements::getDescriptionAsText(std::ostream& out) const {
    CObservation::getDescriptionAsText(out);
    out << measurements.size() << " measurements\n";
}

}  // namespace salma::slam
