// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "TCalibrationOptions.h"
#include "decorrelation.h"
#include "detection.h"
#include "detectionTables.h"
#include "duplicateRate.h"
#include "labelledPairs.h"
#include "labelledRun.h"
#include "ratioTable.h"
#include "reliability.h"

namespace salma::apps {

/// Pairs of some runs by kind.
struct TPairCounts {
    std::size_t same{0}, other{0}, duplicate{0};
    std::size_t silent{0};  //!< Too few keypoints to say anything.
};

/// Learning or held-out runs, and what the tables are worth on them.
struct TRunSet {
    std::vector<TLabelledRun> runs;
    std::vector<std::vector<TLabelledPair>> pairs;  //!< By run.
    TPairCounts counts;
    std::size_t posters{0};           //!< Different pictures that were seen.
    TReliability learned;             //!< By the learned tables; duplicates are others.
    TReliability configured;          //!< By the tables of the configuration.
    double areaWithoutDuplicates{0};  //!< Under the curve, by the learned tables.
    TDetectionLoss posterDetection, cornerDetection;
};

struct TCalibration {
    TRunSet learning;
    std::optional<TRunSet> report;
    TRatioTable both;       //!< Keypoints and regions.
    TRatioTable keypoints;  //!< Keypoints alone.
    TDuplicateRate duplicates;
    TDecorrelation decorrelated;
    std::vector<TDetectionCell> detected;  //!< In the learning runs.
    slam::TDetectionOptions detection;     //!< The configured knots with the learned values.
    appearance::TMatcherOptions matcher;   //!< The configured ones with the learned tables.
    std::vector<std::string> notices;
};

/** Learns what the scores of CPatchMatcher are worth, on simulated runs.
 *
 * The keypoint table is learned on all pairs by their keypoint score, since patches whose regions
 * cannot be compared are rare. */
class CCalibration {
 public:
    CCalibration(const TCalibrationOptions& options, const TSlamConfig& config);

    /** \param learning, report Folders that salma-sim wrote. `report` may be empty.
     * \throw std::runtime_error, std::invalid_argument naming folder, file, line and value: see
     * labelRun(); fewer than two folders in all, one folder twice, no poster seen twice, no two
     * different posters, a picture in both sets. */
    TCalibration run(const std::vector<std::string>& learning,
                     const std::vector<std::string>& report) const;

 private:
    TRunSet load(const std::vector<std::string>& folders) const;
    TIndependent worthOf(const TRunSet& set) const;
    void learn(TCalibration& calibration) const;
    void judge(const TCalibration& calibration, TRunSet& set) const;

    TCalibrationOptions m_options;
    TSlamConfig m_config;
};

}  // namespace salma::apps
