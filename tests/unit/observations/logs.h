// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose2D.h>
#include <salma/observations/CObservationPanTilt.h>
#include <salma/observations/CObservationSalientLandmarks.h>

#include <string>
#include <vector>

/// Pieces of small logs; times are seconds after kStart.
namespace salma::test {

constexpr double kStart = 1'000'000'000;  // [s since 1970]

mrpt::obs::CObservation2DRangeScan::Ptr scanAt(double time, const std::string& label = "LASER");
mrpt::obs::CObservationOdometry::Ptr odometryAt(double time, const mrpt::poses::CPose2D& pose);
/// Sightings of `count` landmarks, with or without a covariance of each.
mrpt::obs::CObservationBearingRange::Ptr bearings(std::size_t count, bool ownCovariances);
/// An external picture.
mrpt::obs::CObservationImage::Ptr pictureAt(double time, const std::string& file);
observations::CObservationSalientLandmarks::Ptr recordAt(double time);
observations::CObservationPanTilt::Ptr headAt(double time, double pan);

mrpt::obs::CSensoryFrame::Ptr frame(const std::vector<mrpt::obs::CObservation::Ptr>& observations);
/// Odometry with MRPT's Gaussian model and its default options.
mrpt::obs::CActionCollection::Ptr motion(const mrpt::poses::CPose2D& increment);
/// Odometry with Thrun's model and its default options.
mrpt::obs::CActionCollection::Ptr thrunMotion(const mrpt::poses::CPose2D& increment);
/// Covariance of as many particles as MRPT draws for thrunMotion(), with a fixed seed.
mrpt::math::CMatrixDouble33 thrunCovariance(const mrpt::poses::CPose2D& increment,
                                            unsigned particles);
/// A 3D odometry whose covariance is `variance` times the identity.
mrpt::obs::CActionCollection::Ptr motion3D(const mrpt::poses::CPose3D& increment, double variance);
mrpt::obs::CActionCollection::Ptr noMotion();

}  // namespace salma::test
