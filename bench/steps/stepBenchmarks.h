// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace salma::bench {

/// Registers `ekf/NAME/LANDMARKS` with Google Benchmark for the names "block" (salma's step),
/// "mrpt" (MRPT's step with salma's association) and "stock" (MRPT's class).
void registerEkfSteps(std::size_t landmarks);
std::string nameOfEkfStep(const std::string& step, std::size_t landmarks);

/// Registers `rbpf-step/...` and `rbpf-resample/...`. In a resampling, copies of half of the
/// particles replace the other half.
void registerRbpfSteps(std::size_t particles, std::size_t landmarks);
std::string nameOfRbpfStep(const std::string& what, std::size_t particles, std::size_t landmarks);

}  // namespace salma::bench
