// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/viz/CRunWriter.h>

#include <string>

namespace salma::viz {

/** Draws the map after Ho's fig 3.1 as a PNG of 1600 x 1200.
 *
 * Scan points in grey; odometry, estimated and (aligned with it) true path; 2 sigma ellipses of the
 * robot, green where nothing was seen, blue at a first sight, red at a sighting again; landmarks as
 * plus signs with their ellipses at first (blue) and at last (red). Ellipses that would be too
 * small to see are enlarged; the legend says by how much.
 * \throw std::runtime_error if gnuplot is missing or fails, or the file cannot be written.
 * Source: K. L. Ho, transfer report, 2004, fig 3.1. */
void plotMap(const TReportInput& input, const std::string& file);

/** Draws range and bearing innovations over time with their 2 sigma bounds as a PNG of 1600 x 1000.
 *
 * Lines break where nothing known was seen; the titles hold the share of samples inside the bounds.
 * \throw std::runtime_error as plotMap(). Source: K. L. Ho, transfer report, 2004, fig 3.2. */
void plotInnovations(const slam::TRunRecord& record, const std::string& file);

}  // namespace salma::viz
