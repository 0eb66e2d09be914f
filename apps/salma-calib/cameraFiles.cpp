// SPDX-License-Identifier: BSD-3-Clause
#include "cameraFiles.h"

#include <mrpt/core/bits_math.h>

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace salma::apps {
namespace {

constexpr auto kSection = "CAMERA_PARAMS";

/// Reads back to the same double.
std::string exact(double value) {
    std::array<char, 64> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
    return std::string(text.data(), end.ptr);
}

std::vector<double> distortionOf(const mrpt::img::TCamera& camera) {
    return {camera.k1(), camera.k2(), camera.p1(), camera.p2(), camera.k3()};
}

}  // namespace

std::string cameraSection(const mrpt::img::TCamera& camera) {
    std::string dist;
    for (const double d : distortionOf(camera)) dist += (dist.empty() ? "" : " ") + exact(d);
    return std::string("[") + kSection + "]\nresolution = [" + std::to_string(camera.ncols) + " " +
           std::to_string(camera.nrows) + "]\ncx = " + exact(camera.cx()) +
           "\ncy = " + exact(camera.cy()) + "\nfx = " + exact(camera.fx()) +
           "\nfy = " + exact(camera.fy()) + "\ndistortion_model = plumb_bob\n" + "dist = [" + dist +
           "]\n";
}

std::string cameraYaml(const mrpt::img::TCamera& camera, const std::string& name) {
    std::string d;
    for (const double value : distortionOf(camera)) d += (d.empty() ? "" : ", ") + exact(value);
    const std::string fx = exact(camera.fx()), fy = exact(camera.fy()), cx = exact(camera.cx()),
                      cy = exact(camera.cy());
    return "image_width: " + std::to_string(camera.ncols) +
           "\nimage_height: " + std::to_string(camera.nrows) + "\ncamera_name: " + name +
           "\ncamera_matrix:\n  rows: 3\n  cols: 3\n  data: [" + fx + ", 0, " + cx + ", 0, " + fy +
           ", " + cy +
           ", 0, 0, 1]\ndistortion_model: plumb_bob\ndistortion_coefficients:\n  rows: 1\n  cols: "
           "5\n  data: [" +
           d +
           "]\nrectification_matrix:\n  rows: 3\n  cols: 3\n  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n"
           "projection_matrix:\n  rows: 3\n  cols: 4\n  data: [" +
           fx + ", 0, " + cx + ", 0, 0, " + fy + ", " + cy + ", 0, 0, 0, 1, 0]\n";
}

std::string sensorSection(const std::string& label, const mrpt::poses::CPose3D& T_r_s) {
    using mrpt::RAD2DEG;
    return "[" + label + "]\nsensorLabel = " + label + "\npose_x = " + exact(T_r_s.x()) +
           "\npose_y = " + exact(T_r_s.y()) + "\npose_z = " + exact(T_r_s.z()) +
           "\npose_yaw = " + exact(RAD2DEG(T_r_s.yaw())) +
           "\npose_pitch = " + exact(RAD2DEG(T_r_s.pitch())) +
           "\npose_roll = " + exact(RAD2DEG(T_r_s.roll())) + "\n";
}

void writeFile(const std::string& file, const std::string& text) {
    std::ofstream out(file, std::ios::binary);
    out << text;
    out.close();
    if (!out) throw std::runtime_error(file + ": cannot be written");
}

std::string fixed(double value, int digits) {
    if (std::isnan(value)) return "-";
    std::array<char, 400> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                   std::chars_format::fixed, digits);
    return std::string(text.data(), end.ptr);
}

}  // namespace salma::apps
