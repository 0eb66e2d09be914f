// SPDX-License-Identifier: BSD-3-Clause
#include <salma/observations/TPlaceString.h>

#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace salma::observations {
namespace {

constexpr std::size_t kShown = 40;  // characters of a wrong letter that an error repeats

[[noreturn]] void fail(std::size_t index, const std::string& token, const std::string& problem) {
    throw std::invalid_argument("place string: letter " + std::to_string(index + 1) + " '" +
                                token.substr(0, kShown) + "' " + problem);
}

/// Reads a number at `at` and moves `at` behind it.
double readNumber(const std::string& token, std::size_t& at, std::size_t index) {
    double value = 0;
    const char* end = token.data() + token.size();
    const auto [stop, error] = std::from_chars(token.data() + at, end, value);
    if (error != std::errc() || !std::isfinite(value)) fail(index, token, "has no finite number");
    at = static_cast<std::size_t>(stop - token.data());
    return value;
}

void check(const TPlaceLetter& letter, std::size_t index, const std::string& token) {
    if (std::string("WCcJOX").find(letter.letter) == std::string::npos)
        fail(index, token, "is none of W C c J O X");
    if (!std::isfinite(letter.value)) fail(index, token, "has no finite number");
    if (!(letter.sigma >= 0 && std::isfinite(letter.sigma)))
        fail(index, token, "has a sigma that is negative or not finite");
}

void append(std::string& text, double number) {
    char digits[32];
    const auto written = std::to_chars(digits, digits + sizeof digits, number);
    text.append(digits, written.ptr);
}

}  // namespace

std::string asText(const TPlaceString& place) {
    std::string text;
    for (std::size_t i = 0; i < place.size(); ++i) {
        const TPlaceLetter& letter = place[i];
        check(letter, i, std::string(1, letter.letter));
        if (i > 0) text += ' ';
        text += letter.letter;
        if (letter.value != 0 || letter.sigma != 0) append(text, letter.value);
        if (letter.sigma != 0) append(text += '~', letter.sigma);
    }
    return text;
}

TPlaceString parsePlaceString(const std::string& text) {
    TPlaceString place;
    std::istringstream in(text);
    for (std::string token; in >> token;) {
        const std::size_t index = place.size();
        TPlaceLetter letter{token[0], 0, 0};
        std::size_t at = 1;
        if (at < token.size()) letter.value = readNumber(token, at, index);
        if (at < token.size() && token[at] == '~') letter.sigma = readNumber(token, ++at, index);
        if (at < token.size()) fail(index, token, "has more than a value and a sigma");
        check(letter, index, token);
        place.push_back(letter);
    }
    return place;
}

}  // namespace salma::observations
