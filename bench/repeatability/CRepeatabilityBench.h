// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/saliency/CRepeatability.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "TDetector.h"
#include "TPictureSet.h"

namespace salma::bench {

struct TBenchOptions {
    std::size_t strongest{500};  //!< Regions of the second operating point, in each picture.
    double maxOverlapError{0.4};
    int threads{1};  //!< The result does not depend on it.
};

/// The first picture of a set and another, as one detector sees them.
struct TBenchRow {
    std::string set;
    std::string detector;
    std::string point;       //!< Operating point: "default" or "strongest".
    std::size_t picture{0};  //!< Number of the second picture, from 2.
    TViewChange change;
    std::size_t firstRegions{0};   //!< Found in the whole first picture.
    std::size_t secondRegions{0};  //!< Found in the whole second.
    saliency::TRepeatability result;
    double chance{0};  //!< Repeatability if the second picture's regions lay elsewhere: turned by
                       //!< 180 degrees about its middle.
};

/** Measures the repeatability of detectors on sets of pictures.
 *
 * Two operating points, since regions found by chance grow with their density: each detector with
 * its default options, and the same number of strongest regions of each in each picture. */
class CRepeatabilityBench {
 public:
    CRepeatabilityBench(std::vector<TDetector> detectors, const TBenchOptions& options);

    /** By operating point, detector, picture.
     * \param regionFolder Gets a folder SET/POINT with the regions of each picture as VGG files
     * imgK.DETECTOR. \throw std::runtime_error if they cannot be written. */
    std::vector<TBenchRow> run(const TPictureSet& set,
                               const std::filesystem::path& regionFolder) const;

    const std::vector<TDetector>& detectors() const { return m_detectors; }
    const TBenchOptions& options() const { return m_options; }

 private:
    std::vector<TBenchRow> compare(const TPictureSet& set,
                                   const TDetector& detector,
                                   const std::vector<TDetector::Regions>& regions) const;

    std::vector<TDetector> m_detectors;
    TBenchOptions m_options;
};

}  // namespace salma::bench
