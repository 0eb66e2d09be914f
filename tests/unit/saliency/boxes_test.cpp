// SPDX-License-Identifier: BSD-3-Clause
// On real pictures: do the strongest regions lie on posters, boards, signs and doors?
#include <gtest/gtest.h>
#include <salma/saliency/CGreedyClusterer.h>
#include <salma/saliency/CScaleSaliency.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "CTemporaryFolder.h"

namespace salma::saliency {
namespace {

struct TBox {
    int x0{0};
    int y0{0};
    int x1{0};
    int y1{0};
};

/// Boxes by picture, from the hand-drawn table.
std::map<std::string, std::vector<TBox>> readBoxes() {
    std::map<std::string, std::vector<TBox>> boxes;
    std::istringstream lines(salma::test::readFile(SALMA_SOURCE_DIR "/tests/data/boxes/boxes.csv"));
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
        TBox box;
        const std::size_t comma = line.find(',');
        const int read =
            std::sscanf(line.c_str() + comma, ",%d,%d,%d,%d", &box.x0, &box.y0, &box.x1, &box.y1);
        EXPECT_EQ(read, 4) << line;
        boxes[line.substr(0, comma)].push_back(box);
    }
    return boxes;
}

bool inside(const observations::TSalientRegion& region, const std::vector<TBox>& boxes) {
    return std::any_of(boxes.begin(), boxes.end(), [&region](const TBox& box) {
        return box.x0 <= region.x && region.x <= box.x1 && box.y0 <= region.y && region.y <= box.y1;
    });
}

TEST(SalientRegionsOfRealPictures, LieOnPostersBoardsSignsAndDoorsInFourOfFiveCases) {
    SALMA_NEED_DATA(corridor, "corridor_images");
    SALMA_NEED_DATA(mural, "homography/churchill/1.png");
    std::size_t strongest = 0;
    std::size_t hits = 0;
    for (const auto& [picture, boxes] : readBoxes()) {
        const std::string file =
            picture == "churchill1" ? mural : corridor + "/" + picture + ".jpg";
        const cv::Mat grey = cv::imread(file, cv::IMREAD_GRAYSCALE);
        auto regions = CGreedyClusterer().cluster(CScaleSaliency().detect(grey)).regions;
        ASSERT_GE(regions.size(), 20u) << file;
        regions.resize(20);
        const auto good =
            std::count_if(regions.begin(), regions.end(),
                          [&boxes = boxes](const auto& region) { return inside(region, boxes); });
        std::cout << "  " << picture << ": " << good << " of 20 strongest regions in boxes\n";
        strongest += regions.size();
        hits += static_cast<std::size_t>(good);
    }
    EXPECT_EQ(strongest, 220u);
    EXPECT_GE(static_cast<double>(hits), 0.8 * static_cast<double>(strongest));
}

}  // namespace
}  // namespace salma::saliency
