// SPDX-License-Identifier: BSD-3-Clause
#include "readPicture.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <system_error>

namespace salma::apps {
namespace {

[[noreturn]] void fail(const std::string& file, const std::string& problem) {
    throw std::runtime_error(file + ": " + problem);
}

/// Whether a file begins like JPEG or PNG but does not end like it. The decoder would fill the rest
/// of a JPEG picture with grey, and print a line of its own.
bool breaksOff(const std::string& bytes) {
    if (bytes.compare(0, 4, "\x89PNG") == 0) return bytes.find("IEND") == std::string::npos;
    if (bytes.compare(0, 2, "\xff\xd8") != 0) return false;
    const std::size_t lastScan = bytes.rfind("\xff\xda");
    return lastScan == std::string::npos || bytes.find("\xff\xd9", lastScan) == std::string::npos;
}

}  // namespace

cv::Mat readGrey(const std::string& file) {
    if (std::error_code ignored; !std::filesystem::is_regular_file(file, ignored))
        fail(file, "is missing, or not a file");
    std::ifstream in(file, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    if (!in || bytes.empty()) fail(file, "cannot be read, or is empty");
    if (breaksOff(bytes)) fail(file, "is a picture that breaks off");
    cv::Mat grey;
    try {
        const std::vector<char> buffer(bytes.begin(), bytes.end());
        grey = cv::imdecode(buffer, cv::IMREAD_GRAYSCALE | cv::IMREAD_ANYDEPTH);
    } catch (const cv::Exception&) {  // thrown for a few broken files, others give an empty picture
    }
    if (grey.empty()) fail(file, "cannot be read as a picture");
    if (grey.depth() != CV_8U) fail(file, "has more than 8 bits for each channel");
    return grey;
}

void rejectEqualStems(const std::vector<std::string>& pictures) {
    std::map<std::string, std::string> seen;
    for (const auto& picture : pictures) {
        const auto [other, isNew] =
            seen.emplace(std::filesystem::path(picture).stem().string(), picture);
        if (!isNew)
            throw std::invalid_argument(other->second + " and " + picture +
                                        ": results of both would be named " + other->first);
    }
}

}  // namespace salma::apps
