// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <TSlamConfig.h>

#include "TDemo.h"

namespace salma::bench {

/// What salma-slam makes of the log with this configuration. \throw std::runtime_error
TDemoRun runSalma(const TDemo& demo, const apps::TSlamConfig& config);

}  // namespace salma::bench
