// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/slam/TRunRecord.h>
#include <salma/viz/TTrajectory.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace salma::viz {

/// What a run left, and the true path where it is known.
struct TReportInput {
    const slam::TRunRecord& record;    //!< Must outlive this object.
    std::optional<TTrajectory> truth;  //!< In any frame: it is aligned with the estimate.
};

/// The path of a run as the filter estimated it, and by odometry alone.
TTrajectory estimatedPath(const slam::TRunRecord& record);
TTrajectory odometryPath(const slam::TRunRecord& record);

/// How often each decision was taken.
struct TDecisionCounts {
    std::size_t paired{0}, created{0}, deferred{0}, clutter{0}, relocated{0}, provisional{0};
};
TDecisionCounts countDecisions(const slam::TRunRecord& record);

/// Names as the files hold them: "paired", "new", ...; "nearest", ...; "salient", "corner".
std::string nameOf(slam::EDecision decision);
std::string nameOf(association::EReason reason);
std::string nameOf(association::ELandmarkKind kind);

/// Columns of the files, in their order.
std::vector<std::string> landmarkColumns();
std::vector<std::string> spatialLandmarkColumns();
std::vector<std::string> associationColumns();
std::vector<std::string> candidateColumns();
std::vector<std::string> innovationColumns();
std::vector<std::string> relocationColumns();

/** Writes the files of a run folder.
 *
 * Numbers have 9 significant digits, stamps 6 decimals; NaN and "none" are empty cells. Every write
 * is checked. The folder must exist; what is in it under the same name is overwritten.
 * \throw std::runtime_error naming the file that could not be written. */
class CRunWriter {
 public:
    explicit CRunWriter(std::filesystem::path folder);

    /// trajectory.tum, landmarks.csv, associations.csv, candidates.csv, innovations.csv,
    /// relocations.csv, summary.json; of a filter in space also landmarks3d.csv.
    void writeTables(const slam::TRunRecord& record) const;

    /** The tables, map.png, innovations.png, scene.3Dscene and report.html.
     * \throw std::runtime_error also if gnuplot is missing or fails. */
    void writeAll(const TReportInput& input) const;

 private:
    std::filesystem::path m_folder;
};

}  // namespace salma::viz
