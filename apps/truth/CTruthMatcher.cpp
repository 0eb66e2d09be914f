// SPDX-License-Identifier: BSD-3-Clause
#include "CTruthMatcher.h"

#include <mrpt/math/wrap2pi.h>
#include <salma/viz/CCsvTable.h>
#include <salma/viz/CRunWriter.h>
#include <salma/viz/CTrajectoryScore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace salma::apps {
namespace {

using association::ELandmarkKind;
using slam::EDecision;
using slam::TAssociationRow;

void requirePositive(const std::string& key, double value) {
    if (!(value > 0 && std::isfinite(value)))
        throw std::invalid_argument(key + " = " + std::to_string(value) + " must be in (0, inf)");
}

/// Name in the file to value.
template <class ENUM, std::size_t N>
ENUM parsed(const viz::CCsvTable& table,
            std::size_t row,
            const std::string& column,
            const std::array<ENUM, N>& values) {
    for (const ENUM value : values)
        if (viz::nameOf(value) == table.text(row, column)) return value;
    table.fail(row, column, "is not known");
}

constexpr std::array<EDecision, 6> kDecisions{EDecision::paired,    EDecision::created,
                                              EDecision::deferred,  EDecision::clutter,
                                              EDecision::relocated, EDecision::provisional};
constexpr std::array<ELandmarkKind, 2> kKinds{ELandmarkKind::salient, ELandmarkKind::corner};

std::size_t count(const viz::CCsvTable& table, std::size_t row, const std::string& column) {
    const int value = table.integer(row, column);
    if (value < 0) table.fail(row, column, "is negative");
    return static_cast<std::size_t>(value);
}

TAssociationRow readRow(const viz::CCsvTable& table, std::size_t i) {
    TAssociationRow row;
    row.time = table.number(i, "t_s");
    row.observation = count(table, i, "observation");
    row.kind = parsed(table, i, "kind", kKinds);
    row.range = table.number(i, "range_m");
    row.bearing = table.number(i, "bearing_deg") * M_PI / 180;
    row.u = table.numberOrNaN(i, "u_px");
    row.v = table.numberOrNaN(i, "v_px");
    row.decision = parsed(table, i, "decision", kDecisions);
    row.landmark = table.integerOr(i, "landmark_id", -1);
    const bool needsId = row.decision == EDecision::paired || row.decision == EDecision::created;
    if (needsId && row.landmark < 0) table.fail(i, "landmark_id", "names no landmark");
    row.distance2 = table.numberOrNaN(i, "d2");
    row.logRatio = table.numberOrNaN(i, "log_lr");
    row.candidates = count(table, i, "n_candidates");
    return row;
}

}  // namespace

void TTruthMatcherOptions::visit(config::COptionVisitor& v) {
    v.number("max_skew_s", maxSkew, config::moreThan(0),
             "between the time of an observation and of its picture");
    v.number("max_distance_px", maxPixels, config::moreThan(0),
             "from the true centre in a picture");
    v.number("max_range_error_m", maxRange, config::moreThan(0), "from the true range");
    v.degrees("max_bearing_error_deg", maxBearing, config::moreThan(0), "from the true bearing");
    v.number("max_corner_error_m", maxCorner, config::moreThan(0), "from the true corner");
    v.number("max_gap_s", maxGap, config::moreThan(0),
             "longest gap of the true path that is interpolated over");
}

void TTruthMatcherOptions::validate() const {
    requirePositive("max_skew_s", maxSkew);
    requirePositive("max_distance_px", maxPixels);
    requirePositive("max_range_error_m", maxRange);
    requirePositive("max_bearing_error_deg", maxBearing);
    requirePositive("max_corner_error_m", maxCorner);
    requirePositive("max_gap_s", maxGap);
}

CTruthMatcher::CTruthMatcher(const TTruthMatcherOptions& options, const TTruth& truth)
    : m_options(options), m_truth(truth) {
    m_options.validate();
}

bool CTruthMatcher::knowsCorners() const {
    return m_truth.path &&
           std::any_of(m_truth.landmarks.begin(), m_truth.landmarks.end(),
                       [](const auto& l) { return l.kind == ELandmarkKind::corner; });
}

int CTruthMatcher::match(const TAssociationRow& row) const {
    return row.kind == ELandmarkKind::salient ? matchSalient(row) : matchCorner(row);
}

int CTruthMatcher::matchSalient(const TAssociationRow& row) const {
    const double skew = m_options.maxSkew;
    auto sighting =
        std::lower_bound(m_truth.sightings.begin(), m_truth.sightings.end(), row.time - skew,
                         [](const auto& s, double time) { return s.time < time; });
    int found = -1;
    double least = 1;  // distances count in units of their limit
    for (; sighting != m_truth.sightings.end() && sighting->time <= row.time + skew; ++sighting) {
        if (sighting->kind != ELandmarkKind::salient) continue;
        const double pixels =
            std::hypot(row.u - sighting->u, row.v - sighting->v) / m_options.maxPixels;
        const double metric = std::max(
            std::abs(row.range - sighting->range) / m_options.maxRange,
            std::abs(mrpt::math::wrapToPi(row.bearing - sighting->bearing)) / m_options.maxBearing);
        // without a place in the picture `pixels` is NaN, and fmin takes the other
        const double distance = std::fmin(metric, pixels);
        if (!(distance <= least)) continue;
        least = distance;
        found = sighting->landmark;
    }
    return found;
}

int CTruthMatcher::matchCorner(const TAssociationRow& row) const {
    mrpt::poses::CPose2D T_w_r;
    if (!m_truth.path || !viz::interpolate(*m_truth.path, row.time, m_options.maxGap, T_w_r))
        return -1;
    const double direction = T_w_r.phi() + row.bearing;
    const mrpt::math::TPoint2D seen(T_w_r.x() + row.range * std::cos(direction),
                                    T_w_r.y() + row.range * std::sin(direction));
    int found = -1;
    double least = m_options.maxCorner;
    for (const auto& landmark : m_truth.landmarks) {
        const double distance = (landmark.position - seen).norm();
        if (landmark.kind != ELandmarkKind::corner || !(distance <= least)) continue;
        least = distance;
        found = landmark.id;
    }
    return found;
}

std::vector<TAssociationRow> readAssociations(const std::string& file) {
    const viz::CCsvTable table(file, viz::associationColumns());
    std::vector<TAssociationRow> rows;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        rows.push_back(readRow(table, i));
        if (i > 0 && rows[i].time < rows[i - 1].time)
            table.fail(i, "t_s", "is smaller than the one before");
    }
    return rows;
}

}  // namespace salma::apps
