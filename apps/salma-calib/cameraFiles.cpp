// SPDX-License-Identifier: BSD-3-Clause
#include "cameraFiles.h"

#include <mrpt/core/bits_math.h>
#include <salma/config/CStrictFile.h>
#include <salma/config/CStrictSection.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
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

/// The numbers of "[a b c]". \throw std::invalid_argument through `ini`.
std::vector<double> readVector(config::CStrictSection& ini,
                               const std::string& key,
                               std::size_t least,
                               std::size_t most) {
    std::string text;
    ini.text(key, text);
    const bool framed = text.size() >= 2 && text.front() == '[' && text.back() == ']';
    std::istringstream words(framed ? text.substr(1, text.size() - 2) : std::string());
    std::vector<double> values;
    for (std::string word; words >> word;) {
        double value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
            ini.fail(key, "holds '" + word + "', which is no number");
        values.push_back(value);
    }
    if (values.size() < least || values.size() > most)
        ini.fail(key, "is not [a b ...] with " + std::to_string(least) + " to " +
                          std::to_string(most) + " numbers");
    return values;
}

double readNumber(config::CStrictSection& ini,
                  const std::string& key,
                  const config::TRange& range) {
    double value = 0;
    if (!ini.has(key)) ini.fail(key, "is missing");
    ini.number(key, value, range);
    return value;
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

mrpt::img::TCamera readCamera(const std::string& file) {
    const auto ini = config::openStrict(file);
    if (!ini->sectionExists(kSection))
        throw std::invalid_argument(file + ": has no section [" + kSection + "]");
    config::CStrictSection section(*ini, kSection);
    mrpt::img::TCamera camera;
    const auto size = readVector(section, "resolution", 2, 2);
    for (const double side : size)
        if (side < 1 || side > 1e5 || side != std::floor(side))
            section.fail("resolution", "is not two whole numbers from 1");
    camera.ncols = static_cast<std::uint32_t>(size[0]);
    camera.nrows = static_cast<std::uint32_t>(size[1]);
    camera.setIntrinsicParamsFromValues(readNumber(section, "fx", config::moreThan(0)),
                                        readNumber(section, "fy", config::moreThan(0)),
                                        readNumber(section, "cx", config::anyNumber()),
                                        readNumber(section, "cy", config::anyNumber()));
    std::string model = "none", ignored;
    section.text("distortion_model", model);  // MRPT's documentation calls it `distortion`
    if (model != "plumb_bob" && model != "none")
        section.fail("distortion_model", "is neither plumb_bob nor none");
    if (section.has("dist")) {
        auto dist = readVector(section, "dist", 4, 8);
        dist.resize(8);
        if (dist[5] != 0 || dist[6] != 0 || dist[7] != 0)
            section.fail("dist", "has more than k1 k2 p1 p2 k3");
        const bool any = std::any_of(dist.begin(), dist.end(), [](double d) { return d != 0; });
        if (model == "none" && any) section.fail("dist", "needs distortion_model = plumb_bob");
        if (model == "plumb_bob")
            camera.setDistortionPlumbBob(dist[0], dist[1], dist[2], dist[3], dist[4]);
    }
    for (const char* other : {"focal_length", "camera_name"}) section.text(other, ignored);
    section.rejectUnknownKeys();
    return camera;
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
