// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/laser/CPlaneExtractor.h>

#include <Eigen/Core>
#include <optional>
#include <random>
#include <vector>

namespace salma::laser {

/// A line of one scan in space.
struct TSpaceLine {
    std::size_t scan{0};
    Eigen::Vector3d from, to;             //!< Robot frame [m].
    std::vector<Eigen::Vector3d> points;  //!< The readings on it.
    Eigen::Vector3d scanner;              //!< Where these were taken from.
};

/// A plane without its extent.
struct TPlaneFit {
    Eigen::Vector3d normal;
    double distance{0};
    double offset(const Eigen::Vector3d& p) const { return normal.dot(p) - distance; }
};

/// Finds planes among lines, one after the other.
class CPlaneSearch {
 public:
    /// \param lines In the order of their scans; must outlive the search.
    CPlaneSearch(const TPlaneOptions& options, const std::vector<TSpaceLine>& lines);

    /// The free piece with most points; nothing if there is none of the required size.
    std::optional<TPlanePatch> next();

    std::size_t freeLines() const;

 private:
    using Indices = std::vector<std::size_t>;
    /// The plane through line `i` and the middle of one from a scan beside it, drawn at random.
    std::optional<TPlaneFit> draw(std::size_t i);
    /// The plane through the middle of line `i` that is parallel to a plane found before.
    std::optional<TPlaneFit> drawParallel(std::size_t i);
    std::optional<TPlaneFit> bestHypothesis();
    bool lies(const TPlaneFit& fit, std::size_t line) const;
    std::size_t support(const TPlaneFit& fit) const;
    /// The connected piece with most points.
    Indices gather(const TPlaneFit& fit) const;
    std::optional<TPlanePatch> refine(const TPlaneFit& start, const Indices& members) const;

    const TPlaneOptions& m_options;
    const std::vector<TSpaceLine>& m_lines;
    std::vector<char> m_free;
    std::vector<std::size_t> m_firstOfScan;  //!< Index of each scan's first line, and the end.
    std::vector<Eigen::Vector3d> m_normals;  //!< Of the planes found.
    std::mt19937 m_random;
};

}  // namespace salma::laser
