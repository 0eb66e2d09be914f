// SPDX-License-Identifier: BSD-3-Clause
#include "TPictureSet.h"

#include <salma/saliency/ellipseGeometry.h>
#include <salma/saliency/regionFiles.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "readPicture.h"

namespace fs = std::filesystem;

namespace salma::bench {
namespace {

constexpr int kMostPictures = 99;

/// How a set names its files.
struct TNames {
    std::string picture;  //!< Before the number.
    std::string before;   //!< Of a homography, before the number.
    std::string after;
};

/// Path of picture `number`, "" if there is none.
std::string pictureFile(const fs::path& folder, const TNames& names, int number) {
    for (const char* kind : {".ppm", ".pgm", ".png", ".jpg"}) {
        const fs::path file = folder / (names.picture + std::to_string(number) + kind);
        if (fs::exists(file)) return file.string();
    }
    return "";
}

TNames namesOf(const fs::path& folder) {
    for (const TNames& names : {TNames{"img", "H1to", "p"}, TNames{"", "H_1_", ""}})
        if (!pictureFile(folder, names, 1).empty()) return names;
    throw std::runtime_error(folder.string() +
                             ": holds no img1 (as VGG's sets) and no 1 (as HPatches), .ppm, .pgm, "
                             ".png or .jpg");
}

int countPictures(const fs::path& folder, const TNames& names) {
    int last = 1;
    for (int number = 2; number <= kMostPictures; ++number)
        if (!pictureFile(folder, names, number).empty()) last = number;
    for (int number = 2; number <= std::max(2, last); ++number)
        if (pictureFile(folder, names, number).empty())
            throw std::runtime_error((folder / (names.picture + std::to_string(number))).string() +
                                     ".*: this picture is missing");
    return last;
}

/// Name of a folder, also of "dir/" and ".".
std::string nameOf(const fs::path& folder) {
    const fs::path whole = fs::weakly_canonical(folder);
    return whole.filename().empty() ? "root" : whole.filename().string();
}

}  // namespace

TPictureSet readPictureSet(const std::string& folder) {
    if (!fs::is_directory(folder)) throw std::runtime_error(folder + ": is not a folder");
    const TNames names = namesOf(folder);
    const int count = countPictures(folder, names);
    TPictureSet set{nameOf(folder), {}, {cv::Matx33d::eye()}};
    for (int number = 1; number <= count; ++number)
        set.pictures.push_back(apps::readGrey(pictureFile(folder, names, number)));
    for (int number = 2; number <= count; ++number)
        set.H_picture_first.push_back(saliency::readHomography(
            (fs::path(folder) / (names.before + std::to_string(number) + names.after)).string()));
    return set;
}

TViewChange viewChange(const cv::Matx33d& H_2_1, const cv::Size& first) {
    const saliency::TEllipse middle{(first.width - 1) / 2.0, (first.height - 1) / 2.0, 1, 0, 1};
    const auto image = saliency::mapped(H_2_1, middle);
    if (!image) throw std::runtime_error("a homography maps the middle of a picture to infinity");
    const double mean = (image->a + image->c) / 2;
    const double difference = std::hypot((image->a - image->c) / 2, image->b);
    return {image->radius(), std::sqrt((mean + difference) / (mean - difference))};
}

}  // namespace salma::bench
