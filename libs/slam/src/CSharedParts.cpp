// SPDX-License-Identifier: BSD-3-Clause
#include <salma/slam/CSharedParts.h>

#include <random>

namespace salma::slam {

std::uint64_t processNumber() {
    static const std::uint64_t number = [] {
        std::random_device random;
        return (std::uint64_t{random()} << 32) | random();
    }();
    return number;
}

}  // namespace salma::slam
