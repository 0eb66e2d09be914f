// SPDX-License-Identifier: BSD-3-Clause
#include "truthFiles.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace salma::simulator {
namespace {

/// printf into a string; lines of these files are short.
template <class... ARGS>
std::string line(const char* format, ARGS... args) {
    char text[256];
    std::snprintf(text, sizeof text, format, args...);
    return text;
}

void writeText(const std::filesystem::path& file, const std::string& text) {
    std::ofstream out(file, std::ios::binary);
    out << text;
    out.close();
    if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace

void writeTrajectory(const std::filesystem::path& file, const std::vector<TTruePose>& poses) {
    std::string text;
    for (const auto& p : poses)
        text += line("%.6f %.6f %.6f 0 0 0 %.9f %.9f\n", p.stamp, p.pose.x, p.pose.y,
                     std::sin(p.pose.phi / 2), std::cos(p.pose.phi / 2));
    writeText(file, text);
}

void writeLandmarks(const std::filesystem::path& file,
                    const std::vector<TTrueLandmark>& landmarks) {
    std::string text = "id,kind,x_m,y_m,z_m,yaw_deg,width_m,height_m,texture\n";
    for (const auto& l : landmarks) {
        const bool salient = l.kind == ETruthKind::salient;
        text += line("%d,%s,%.4f,%.4f,%.4f,", l.id, salient ? "salient" : "corner", l.centre.x(),
                     l.centre.y(), l.centre.z());
        text += salient ? line("%.3f,%.3f,%.3f,", mrpt::RAD2DEG(l.yaw), l.width, l.height) +
                              l.texture + "\n"
                        : ",,,\n";
    }
    writeText(file, text);
}

void writeSightings(const std::filesystem::path& file, const std::vector<TSighting>& sightings) {
    std::string text = "t_s,landmark_id,u_px,v_px,range_m,bearing_deg\n";
    for (const auto& s : sightings) {
        text += line("%.6f,%d,", s.stamp, s.landmark);
        text += std::isnan(s.u) ? "," : line("%.2f,%.2f", s.u, s.v);
        text += line(",%.4f,%.3f\n", s.range, mrpt::RAD2DEG(s.bearing));
    }
    writeText(file, text);
}

void writeRawlog(const std::filesystem::path& file,
                 std::vector<mrpt::obs::CObservation::Ptr> records) {
    std::stable_sort(records.begin(), records.end(),
                     [](const auto& a, const auto& b) { return a->timestamp < b->timestamp; });
    mrpt::io::CFileGZOutputStream out;
    if (!out.open(file.string())) throw std::runtime_error(file.string() + ": cannot be written");
    auto archive = mrpt::serialization::archiveFrom(out);
    for (const auto& record : records) archive << *record;
}

}  // namespace salma::simulator
