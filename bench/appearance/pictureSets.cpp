// SPDX-License-Identifier: BSD-3-Clause
#include "pictureSets.h"

#include <map>

namespace salma::bench {
namespace {

const std::string kPhotographs = "/usr/share/doc/opencv-doc/examples/data/";

const std::map<std::string, std::vector<std::string>> kSets = {
    // on these, options and gates were chosen
    {"tuning",
     {"posters/MonaLisa.png", "posters/GreatWave.png", "posters/Arcimboldo_Spring.png",
      "posters/KazusaSeaRoute.png", "posters/HokusaiPoppies.png", "posters/AlbrechtDurer.png",
      "posters/kodak01.png", "posters/kodak05.png", "posters/kodak09.png",
      "posters/Michelangelo_Pieta.png"}},
    // these were looked at once all but the table of ratios was fixed
    {"report",
     {"posters/Arcimboldo_Librarian.png", "posters/EjiriSuruga.png",
      "posters/HiroshigeHorsePrawns.png", "posters/HokusaiBridge.png",
      "posters/HokusaiOiranKamuro.png", "posters/HiroshigeInokashiraSnow.png",
      "posters/kodak03.png", "posters/HokusaiWomanHoldingFan.png", "posters/kodak07.png",
      "posters/kodak11.png"}},
    // these after that; the corridor's pictures show one corridor
    {"last",
     {"homography/graf/img1.ppm", "homography/boat/img1.pgm", "homography/churchill/1.png",
      "corridor_images/1.jpg", "corridor_images/12.jpg", "corridor_images/24.jpg",
      "corridor_images/36.jpg"}},
    // these after views were refused less often; photographs of Debian's opencv-doc
    {"held-out",
     {kPhotographs + "fruits.jpg", kPhotographs + "home.jpg", kPhotographs + "butterfly.jpg",
      kPhotographs + "baboon.jpg", kPhotographs + "building.jpg", kPhotographs + "messi5.jpg",
      kPhotographs + "squirrel_cls.jpg", kPhotographs + "board.jpg", kPhotographs + "stuff.jpg",
      kPhotographs + "starry_night.jpg"}}};

}  // namespace

std::vector<std::string> pictureSetNames() {
    std::vector<std::string> names;
    for (const auto& [name, pictures] : kSets) names.push_back(name);
    return names;
}

const std::vector<std::string>& pictureSet(const std::string& name) { return kSets.at(name); }

std::string pictureFile(const std::string& data, const std::string& name) {
    return name[0] == '/' ? name : data + "/" + name;
}

}  // namespace salma::bench
