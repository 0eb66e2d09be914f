// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/config/CConfigFile.h>

#include <memory>
#include <string>
#include <vector>

namespace salma::config {

/** Opens an ini file for strict reading.
 *
 * MRPT takes a missing file for an empty one, skips lines it cannot read, and lets a repeated key
 * overwrite the first. Here each of these is an error.
 * \throw std::invalid_argument naming file and line. */
std::unique_ptr<mrpt::config::CConfigFile> openStrict(const std::string& file);

/** \param known Names of the sections that something reads; a name that ends in '*' stands for
 * all that begin so. \throw std::invalid_argument naming the file and every other section. */
void rejectUnknownSections(const mrpt::config::CConfigFileBase& file,
                           const std::vector<std::string>& known);

/// Name of the file behind `file`, or "(memory)".
std::string fileName(const mrpt::config::CConfigFileBase& file);

}  // namespace salma::config
