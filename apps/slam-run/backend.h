// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/slam/CSlamBackend.h>

#include <memory>
#include <string>
#include <vector>

#include "TSlamConfig.h"

namespace salma::apps {

/// The filter that `config` asks for, with the matcher of patches it states.
std::unique_ptr<slam::CSlamBackend> createBackend(const TSlamConfig& config);

/// Names of back ends and methods, as the command lines and config.ini have them.
std::vector<std::string> backendNames();
std::vector<std::string> methodNames();

/// What the command line puts above the file. \throw std::invalid_argument for an unknown name.
void setBackend(const std::string& name, TSlamConfig& config);
void setMethod(const std::string& name, TSlamConfig& config);
/// Of all random steps.
void setSeed(int seed, TSlamConfig& config);

}  // namespace salma::apps
