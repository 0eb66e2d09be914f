// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/config/CConfigFileMemory.h>
#include <salma/config/CStrictSection.h>
#include <salma/viz/CPlots.h>
#include <salma/viz/CReport.h>
#include <salma/viz/CRunWriter.h>
#include <salma/viz/CSceneBuilder.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "CTextFile.h"

namespace salma::viz {
namespace {

using association::ELandmarkKind;
using association::EReason;
using slam::EDecision;
using slam::TRunRecord;
using Cells = std::vector<std::string>;

std::string joined(const Cells& cells) {
    std::string line;
    for (const auto& cell : cells) line += (line.empty() ? "" : ",") + cell;
    return line + "\n";
}

/// Writes a table of `count` rows; `cellsOf(i)` is row i.
template <class CELLS_OF>
void writeCsv(const std::filesystem::path& file,
              const Cells& columns,
              std::size_t count,
              const CELLS_OF& cellsOf) {
    CTextFile text(file.string());
    text.out() << joined(columns);
    for (std::size_t i = 0; i < count; ++i) text.out() << joined(cellsOf(i));
    text.close();
}

double degrees(double radians) { return radians * 180 / M_PI; }

Cells cellsOf(const slam::TMapLandmark& l) {
    return {std::to_string(l.id),
            nameOf(l.kind),
            number(l.mean.x),
            number(l.mean.y),
            number(std::sqrt(l.covariance(0, 0))),
            number(std::sqrt(l.covariance(1, 1))),
            std::to_string(l.sightings),
            stamp(l.firstTime),
            stamp(l.lastTime)};
}

Cells spatialCellsOf(const slam::TMapLandmark& l) {
    return {std::to_string(l.id),
            number(l.mean.x),
            number(l.mean.y),
            number(l.z),
            number(std::sqrt(l.covariance(0, 0))),
            number(std::sqrt(l.covariance(1, 1))),
            number(l.sigmaZ),
            std::to_string(l.sightings)};
}

Cells cellsOf(const slam::TAssociationRow& a) {
    return {stamp(a.time),
            std::to_string(a.observation),
            nameOf(a.kind),
            number(a.range),
            number(degrees(a.bearing)),
            number(a.u),
            number(a.v),
            nameOf(a.decision),
            a.landmark < 0 ? "" : std::to_string(a.landmark),
            number(a.distance2),
            number(a.logRatio),
            std::to_string(a.candidates),
            nameOf(a.reason)};
}

Cells cellsOf(const slam::TCandidateRow& c) {
    return {stamp(c.time),
            std::to_string(c.observation),
            std::to_string(c.landmark),
            number(c.distance2),
            number(c.logRatio),
            c.chosen ? "1" : "0",
            c.inGate ? "1" : "0"};
}

Cells cellsOf(const slam::TRelocationRow& r) {
    return {stamp(r.time),          r.outcome,
            nameOf(r.kind),         std::to_string(r.local),
            std::to_string(r.left), number(r.distance),
            number(r.logRatio),     number(r.shiftX),
            number(r.shiftY),       number(degrees(r.turn)),
            number(r.posters),      number(r.corners),
            number(r.odometry),     std::isfinite(r.margin) ? number(r.margin) : ""};
}

Cells cellsOf(const slam::TInnovationRow& i) {
    return {stamp(i.time), i.component, number(i.value), number(i.sigma)};
}

/// {section: {key: value}} of an ini text, values as they stand there.
nlohmann::ordered_json optionsOf(const std::string& ini) {
    const mrpt::config::CConfigFileMemory file(ini);
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    std::vector<std::string> sections, keys;
    file.getAllSections(sections);
    for (const auto& section : sections) {
        file.getAllKeys(section, keys);
        config::CStrictSection reader(file, section);
        for (const auto& key : keys) {
            std::string value;
            reader.text(key, value);
            json[section][key] = value;
        }
    }
    return json;
}

/// In space where the filter has it so.
void writePath(const TRunRecord& record, const std::string& file) {
    std::vector<TStampedSpatialPose> path;
    for (const auto& row : record.trajectory)
        path.push_back({row.time, row.spatial.value_or(mrpt::poses::CPose3D(row.pose))});
    writeTum(path, file);
}

/// As the filter had it at each time, where that is not the path in the end.
void writeRunningPath(const TRunRecord& record, const std::string& file) {
    if (!record.smoothed) return;
    std::vector<TStampedSpatialPose> path;
    for (const auto& row : record.trajectory)
        path.push_back({row.time, mrpt::poses::CPose3D(row.running)});
    writeTum(path, file);
}

void writeSummary(const TRunRecord& record, const std::string& file) {
    const TDecisionCounts counts = countDecisions(record);
    nlohmann::ordered_json json;
    json["steps"] = record.trajectory.size();
    json["landmarks"] = record.landmarks.size();
    json["paired"] = counts.paired;
    json["new"] = counts.created;
    json["deferred"] = counts.deferred;
    json["clutter"] = counts.clutter;
    json["relocated"] = counts.relocated;
    json["joins"] = record.joins;
    json["removed"] = record.removed;
    json["smoothed"] = record.smoothed;
    json["provisional"] = counts.provisional;
    json["pictures"] = record.pictures;
    json["pictures_without_landmark"] = record.picturesWithoutLandmark;
    json["refused"] = record.refused;
    json["split_groups"] = record.splitGroups;
    json["seconds"] = record.seconds;
    json["seed"] = record.seed;
    json["options"] = optionsOf(record.options);
    json["notices"] = record.notices;
    CTextFile text(file);  // file names in notices need not be UTF-8
    text.out() << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
    text.close();
}

}  // namespace

TTrajectory estimatedPath(const TRunRecord& record) {
    TTrajectory path;
    for (const auto& row : record.trajectory) path.push_back({row.time, row.pose});
    return path;
}

TTrajectory odometryPath(const TRunRecord& record) {
    TTrajectory path;
    for (const auto& row : record.trajectory) path.push_back({row.time, row.odometry});
    return path;
}

TDecisionCounts countDecisions(const TRunRecord& record) {
    TDecisionCounts counts;
    for (const auto& row : record.associations) {
        switch (row.decision) {
            case EDecision::paired:
                ++counts.paired;
                break;
            case EDecision::created:
                ++counts.created;
                break;
            case EDecision::deferred:
                ++counts.deferred;
                break;
            case EDecision::clutter:
                ++counts.clutter;
                break;
            case EDecision::relocated:
                ++counts.relocated;
                break;
            case EDecision::provisional:
                ++counts.provisional;
                break;
        }
    }
    return counts;
}

std::string nameOf(EDecision decision) {
    switch (decision) {
        case EDecision::paired:
            return "paired";
        case EDecision::created:
            return "new";
        case EDecision::deferred:
            return "deferred";
        case EDecision::clutter:
            return "clutter";
        case EDecision::relocated:
            return "relocated";
        case EDecision::provisional:
            return "provisional";
    }
    throw std::invalid_argument("a decision of unknown kind");
}

std::string nameOf(EReason reason) {
    switch (reason) {
        case EReason::nearest:
            return "nearest";
        case EReason::identity:
            return "identity";
        case EReason::unexplained:
            return "unexplained";
        case EReason::nearLandmark:
            return "near_landmark";
        case EReason::taken:
            return "taken";
        case EReason::jointlyImpossible:
            return "jointly_impossible";
        case EReason::ambiguous:
            return "ambiguous";
        case EReason::unsureAppearance:
            return "unsure_appearance";
        case EReason::improbable:
            return "improbable";
        case EReason::tooMany:
            return "too_many";
        case EReason::notFinite:
            return "not_finite";
        case EReason::badCovariance:
            return "bad_covariance";
        case EReason::repeatedIdentity:
            return "repeated_identity";
    }
    throw std::invalid_argument("a reason of unknown kind");
}

std::string nameOf(ELandmarkKind kind) {
    return kind == ELandmarkKind::salient ? "salient" : "corner";
}

std::vector<std::string> landmarkColumns() {
    return {"id",        "kind",      "x_m",       "y_m",     "sigma_x_m",
            "sigma_y_m", "sightings", "first_t_s", "last_t_s"};
}

std::vector<std::string> spatialLandmarkColumns() {
    return {"id", "x_m", "y_m", "z_m", "sigma_x_m", "sigma_y_m", "sigma_z_m", "sightings"};
}

std::vector<std::string> associationColumns() {
    return {"t_s",      "observation", "kind", "range_m", "bearing_deg",  "u_px",  "v_px",
            "decision", "landmark_id", "d2",   "log_lr",  "n_candidates", "reason"};
}

std::vector<std::string> candidateColumns() {
    return {"t_s", "observation", "landmark_id", "d2", "log_lr", "chosen", "in_gate"};
}

std::vector<std::string> relocationColumns() {
    return {"t_s",       "outcome",   "kind",     "local_id", "left_id", "distance_m", "log_lr",
            "shift_x_m", "shift_y_m", "turn_deg", "posters",  "corners", "odometry",   "margin"};
}

std::vector<std::string> innovationColumns() { return {"t_s", "component", "value", "sigma"}; }

CRunWriter::CRunWriter(std::filesystem::path folder) : m_folder(std::move(folder)) {}

void CRunWriter::writeTables(const TRunRecord& r) const {
    writePath(r, (m_folder / "trajectory.tum").string());
    writeRunningPath(r, (m_folder / "running.tum").string());
    writeCsv(m_folder / "landmarks.csv", landmarkColumns(), r.landmarks.size(),
             [&](std::size_t i) { return cellsOf(r.landmarks[i]); });
    if (!r.trajectory.empty() && r.trajectory.front().spatial)
        writeCsv(m_folder / "landmarks3d.csv", spatialLandmarkColumns(), r.landmarks.size(),
                 [&](std::size_t i) { return spatialCellsOf(r.landmarks[i]); });
    writeCsv(m_folder / "associations.csv", associationColumns(), r.associations.size(),
             [&](std::size_t i) { return cellsOf(r.associations[i]); });
    writeCsv(m_folder / "candidates.csv", candidateColumns(), r.candidates.size(),
             [&](std::size_t i) { return cellsOf(r.candidates[i]); });
    writeCsv(m_folder / "innovations.csv", innovationColumns(), r.innovations.size(),
             [&](std::size_t i) { return cellsOf(r.innovations[i]); });
    writeCsv(m_folder / "relocations.csv", relocationColumns(), r.relocations.size(),
             [&](std::size_t i) { return cellsOf(r.relocations[i]); });
    writeSummary(r, (m_folder / "summary.json").string());
}

void CRunWriter::writeAll(const TReportInput& input) const {
    writeTables(input.record);
    const std::string map = (m_folder / "map.png").string();
    const std::string innovations = (m_folder / "innovations.png").string();
    plotMap(input, map);
    plotInnovations(input.record, innovations);
    const std::string scene = (m_folder / "scene.3Dscene").string();
    if (!CSceneBuilder(input.record).build()->saveToFile(scene))
        throw std::runtime_error(scene + ": cannot be written");
    CTextFile report((m_folder / "report.html").string());
    report.out() << CReport(input).html({map, innovations});
    report.close();
}

}  // namespace salma::viz
