// SPDX-License-Identifier: BSD-3-Clause
#include <salma/calibration/CCameraMatrix.h>

#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>

namespace salma::calibration {

std::vector<TSpacePoint> readPoints(const std::string& file, double scale) {
    if (std::error_code ignored; !std::filesystem::is_regular_file(file, ignored))
        throw std::runtime_error(file + ": is missing, or not a file");
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::runtime_error(file + ": cannot be read");
    std::vector<TSpacePoint> points;
    std::size_t number = 0;
    constexpr std::string_view separators = " \t\r,";
    for (std::string line; std::getline(in, line);) {
        const std::string place = file + ":" + std::to_string(++number) + ": ";
        std::string_view rest(line);
        std::array<double, 5> values{};
        std::size_t count = 0;
        for (auto from = rest.find_first_not_of(separators); from != std::string_view::npos;
             from = rest.find_first_not_of(separators)) {
            rest.remove_prefix(from);
            if (count == 0 && rest[0] == '#') break;
            const auto word = rest.substr(0, rest.find_first_of(separators));
            rest.remove_prefix(word.size());
            if (count == values.size())
                throw std::runtime_error(place + "'" + std::string(word) + "' follows x y z u v");
            double& value = values[count++];
            const auto [end, error] =
                std::from_chars(word.data(), word.data() + word.size(), value);
            if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
                throw std::runtime_error(place + "'" + std::string(word) + "' is no number");
        }
        if (count == 0) continue;
        if (count < values.size())
            throw std::runtime_error(place + "has " + std::to_string(count) +
                                     " numbers, not x y z u v");
        points.push_back(
            {{scale * values[0], scale * values[1], scale * values[2]}, {values[3], values[4]}});
    }
    return points;
}

}  // namespace salma::calibration
