// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace salma::bench {

/// False and missed lines and NEES of both methods on simulated scans, as docs/laser.md has them.
void printQuality();

}  // namespace salma::bench
