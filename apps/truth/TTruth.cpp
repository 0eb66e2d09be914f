// SPDX-License-Identifier: BSD-3-Clause
#include "TTruth.h"

#include <salma/viz/CCsvTable.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace salma::apps {
namespace {

namespace fs = std::filesystem;
using association::ELandmarkKind;

constexpr auto kLandmarks = ".landmarks.csv", kSightings = ".sightings.csv", kPath = ".gt.tum";

bool endsWith(const std::string& text, const std::string& end) {
    return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::string onlyName(const fs::path& folder) {
    if (!fs::is_directory(folder)) throw std::runtime_error(folder.string() + ": no such folder");
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string file = entry.path().filename().string();
        if (endsWith(file, kSightings))
            names.insert(file.substr(0, file.size() - std::string(kSightings).size()));
    }
    if (names.empty())
        throw std::runtime_error(folder.string() + ": holds no truth, NAME" + kSightings);
    if (names.size() > 1)
        throw std::runtime_error(folder.string() + ": holds the truth of several logs, such as " +
                                 *names.begin() + " and " + *names.rbegin() +
                                 ": choose with --name");
    return *names.begin();
}

std::vector<TTrueLandmark> readLandmarks(const std::string& file) {
    const viz::CCsvTable table(
        file, {"id", "kind", "x_m", "y_m", "z_m", "yaw_deg", "width_m", "height_m", "texture"});
    std::vector<TTrueLandmark> landmarks;
    std::set<int> ids;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        TTrueLandmark landmark;
        landmark.id = table.integer(i, "id");
        if (landmark.id < 0) table.fail(i, "id", "is negative");
        if (!ids.insert(landmark.id).second) table.fail(i, "id", "stands there twice");
        const std::string& kind = table.text(i, "kind");
        if (kind != "salient" && kind != "corner") table.fail(i, "kind", "is no known kind");
        landmark.kind = kind == "salient" ? ELandmarkKind::salient : ELandmarkKind::corner;
        landmark.position = {table.number(i, "x_m"), table.number(i, "y_m")};
        if (landmark.kind == ELandmarkKind::salient) {
            landmark.yaw = table.number(i, "yaw_deg") * M_PI / 180;
            landmark.texture = table.text(i, "texture");
            if (landmark.texture.empty()) table.fail(i, "texture", "names no texture");
        }
        landmarks.push_back(landmark);
    }
    return landmarks;
}

std::vector<TTrueSighting> readSightings(const std::string& file,
                                         const std::vector<TTrueLandmark>& landmarks) {
    const viz::CCsvTable table(file,
                               {"t_s", "landmark_id", "u_px", "v_px", "range_m", "bearing_deg"});
    std::vector<TTrueSighting> sightings;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        TTrueSighting s;
        s.time = table.number(i, "t_s");
        s.landmark = table.integer(i, "landmark_id");
        const auto landmark = std::find_if(landmarks.begin(), landmarks.end(),
                                           [&](const auto& l) { return l.id == s.landmark; });
        if (landmark == landmarks.end()) table.fail(i, "landmark_id", "is not among the landmarks");
        s.kind = landmark->kind;
        s.u = table.numberOrNaN(i, "u_px");
        s.v = table.numberOrNaN(i, "v_px");
        s.range = table.number(i, "range_m");
        s.bearing = table.number(i, "bearing_deg") * M_PI / 180;
        sightings.push_back(s);
    }
    std::stable_sort(sightings.begin(), sightings.end(),
                     [](const auto& a, const auto& b) { return a.time < b.time; });
    return sightings;
}

}  // namespace

TTruth loadTruth(const fs::path& folder, const std::string& name) {
    TTruth truth;
    truth.name = name.empty() ? onlyName(folder) : name;
    const std::string stem = (folder / truth.name).string();
    truth.landmarks = readLandmarks(stem + kLandmarks);
    truth.sightings = readSightings(stem + kSightings, truth.landmarks);
    if (fs::exists(stem + kPath)) truth.path = viz::readTum(stem + kPath);
    return truth;
}

}  // namespace salma::apps
