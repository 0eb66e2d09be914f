// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <string_view>

namespace salma::simulator {

/** Random numbers of one purpose: each (seed, purpose, index) has a stream of its own, so that no
 * sensor's noise depends on how many numbers another one drew. Same numbers on every platform. */
class CRandom {
 public:
    CRandom(std::uint32_t seed, std::string_view purpose, std::uint64_t index)
        : m_engine(mix(hash(purpose) + mix(seed + mix(index)))) {}

    /// In [0, 1).
    double unit() { return static_cast<double>(m_engine() >> 11) * 0x1p-53; }
    double uniform(double low, double high) { return low + (high - low) * unit(); }
    /// Normally distributed (Box-Muller).
    double normal(double sigma) {
        const double radius = std::sqrt(-2 * std::log(1 - unit()));
        return sigma * radius * std::cos(2 * M_PI * unit());
    }
    std::uint64_t bits() { return m_engine(); }

 private:
    /// FNV-1a.
    static std::uint64_t hash(std::string_view text) {
        std::uint64_t h = 1469598103934665603ULL;
        for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
        return h;
    }
    /// Splitmix64: spreads neighbouring seeds.
    static std::uint64_t mix(std::uint64_t x) {
        x += 0x9E3779B97F4A7C15ULL;
        x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
        x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
        return x ^ (x >> 31);
    }

    std::mt19937_64 m_engine;
};

}  // namespace salma::simulator
