// SPDX-License-Identifier: BSD-3-Clause
#include <salma/config/CStrictFile.h>
#include <salma/config/CStrictSection.h>
#include <salma/observations/readCamera.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace salma::observations {
namespace {

constexpr auto kSection = "CAMERA_PARAMS";

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

}  // namespace salma::observations
