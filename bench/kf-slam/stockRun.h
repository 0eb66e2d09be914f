// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "TDemo.h"

namespace salma::bench {

/// How MRPT's class associates.
enum class EStockMethod { identities, nn, jcbb };

/** MRPT's own filter on the log, as its program kf-slam runs it.
 *
 * \param ini A file of kf-slam; its method of association is replaced.
 * \throw std::runtime_error if log or file cannot be read. */
TDemoRun runStock2D(const TDemo& demo, const std::string& ini, EStockMethod method);
TDemoRun runStock3D(const TDemo& demo, const std::string& ini, EStockMethod method);

}  // namespace salma::bench
