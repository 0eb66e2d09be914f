// SPDX-License-Identifier: BSD-3-Clause
#include "scene.h"

#include <map>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "CPosterViews.h"

namespace salma::bench {
namespace {

const char* const kWalls[] = {"plaster", "brick", "wood", "plain"};

/// Pictures of share/textures, and photographs below SALMA_DATA_DIR.
const std::map<std::string, std::vector<std::string>> kSets = {
    {"tuning",
     {"AlbrechtDurer.jpg", "Arcimboldo_Librarian.jpg", "EjiriSuruga.jpg", "GreatWave.jpg",
      "HokusaiPoppies.jpg", "MonaLisa.jpg"}},
    {"report",
     {"Arcimboldo_Spring.jpg", "HiroshigeHorsePrawns.jpg", "HiroshigeInokashiraSnow.jpg",
      "HokusaiBridge.jpg", "HokusaiOiranKamuro.jpg", "HokusaiWomanHoldingFan.jpg",
      "KazusaSeaRoute.jpg"}},
    {"photographs",
     {"kodak01.png", "kodak03.png", "kodak05.png", "kodak07.png", "kodak09.png", "kodak11.png",
      "Michelangelo_Pieta.png"}}};

simulator::TWall wall(const std::string& name,
                      const std::vector<double>& from,
                      const std::vector<double>& to,
                      const std::string& texture) {
    simulator::TWall w;
    w.name = name;
    w.from = from;
    w.to = to;
    w.texture = texture;
    return w;
}

}  // namespace

std::vector<std::string> filesOf(const std::string& set) {
    const auto found = kSets.find(set);
    if (found == kSets.end()) throw std::invalid_argument("no set of pictures is named " + set);
    const std::string folder = set == "photographs"
                                   ? std::string(SALMA_DATA_DIR) + "/posters/"
                                   : std::string(SALMA_SOURCE_DIR) + "/share/textures/";
    std::vector<std::string> files;
    for (const auto& name : found->second) files.push_back(folder + name);
    return files;
}

THanging hangingOf(const std::string& texture, std::size_t index) {
    const cv::Mat picture = cv::imread(texture);
    if (picture.empty()) throw std::runtime_error(texture + ": cannot be read");
    THanging h;
    h.texture = texture;
    h.wall = kWalls[index % 4];
    h.height = 0.5 + 0.1 * static_cast<double>(index % 3);
    h.width = h.height * picture.cols / picture.rows;
    h.frame = index % 2 == 0 ? 0.015 : 0;
    return h;
}

simulator::TWorld hallWith(const THanging& hanging, bool hung) {
    simulator::TWorld world;
    world.walls = {
        wall("north", {-8, 0}, {8, 0}, hanging.wall), wall("east", {8, 0}, {8, -9}, "plaster"),
        wall("south", {8, -9}, {-8, -9}, "plaster"), wall("west", {-8, -9}, {-8, 0}, "plaster")};
    simulator::TDoor door;
    door.name = "north";
    door.wall = "north";
    const double beside = hanging.width / 2 + 0.6 + door.width / 2;
    door.at = {8 - beside - 2.5, 8 - beside, 8 + beside, 8 + beside + 2.5};
    world.doors = {door};
    simulator::TBox heater;
    heater.name = "heater";
    heater.centre = {0.1, -0.08};
    heater.length = 1.1;
    heater.top = 0.35;  // below the beam, which sees the wall above it
    world.boxes = {heater};
    if (hung) {
        simulator::TPoster poster;
        poster.name = "it";
        poster.wall = "north";
        poster.at = 8;
        poster.centreHeight = CPosterViews::kCentreHeight;
        poster.width = hanging.width;
        poster.height = hanging.height;
        poster.border = hanging.frame;
        poster.texture = hanging.texture;
        world.posters = {poster};
    }
    world.camera.exposureSigma = 0.2;  // a camera that sets its exposure anew each time
    return world;
}

}  // namespace salma::bench
