// SPDX-License-Identifier: BSD-3-Clause
#include "textures.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "seeds.h"

namespace salma::simulator {
namespace {

cv::Mat filled(int columns, int rows, const cv::Scalar& colour) {
    return {rows, columns, CV_8UC3, colour};
}

/// Adds the same normal noise to all three colours; `grain` smooths it [px], wrapping around.
void addGrain(cv::Mat& picture, double sigma, cv::Size grain, std::uint64_t seed) {
    cv::Mat noise(picture.size(), CV_32F);
    cv::RNG(seed).fill(noise, cv::RNG::NORMAL, 0, 1);
    if (grain.width > 1 || grain.height > 1) {
        cv::Mat wide;  // blur with wrapped borders so that the tile has no seam
        cv::copyMakeBorder(noise, wide, grain.height, grain.height, grain.width, grain.width,
                           cv::BORDER_WRAP);
        cv::blur(wide, wide, grain);
        noise = wide({grain.width, grain.height, picture.cols, picture.rows}).clone();
    }
    cv::Scalar mean, deviation;
    cv::meanStdDev(noise, mean, deviation);
    noise *= sigma / deviation[0];
    cv::Mat three;
    cv::merge(std::vector<cv::Mat>(3, noise), three);
    cv::add(picture, three, picture, cv::noArray(), CV_8UC3);
}

TBuiltInTexture plaster() {
    cv::Mat p = filled(1024, 1024, {196, 208, 212});
    addGrain(p, 1.2, {3, 3}, 11);
    addGrain(p, 1.5, {129, 129}, 12);
    return {p, 4.0};
}

TBuiltInTexture plain() { return {filled(8, 8, {140, 158, 168}), 1.0}; }

TBuiltInTexture brick() {
    constexpr int pitchX = 90, pitchY = 30, joint = 4;  // at 400 px/m
    cv::Mat p = filled(9 * pitchX, 16 * pitchY, {150, 158, 162});
    CRandom random(7, "brick", 0);
    for (int row = 0; row < 16; ++row)
        for (int i = 0; i < 9; ++i) {
            const double tone = random.uniform(0.85, 1.12);
            const cv::Scalar colour(62 * tone, 78 * tone, 142 * tone);
            const int x = i * pitchX + (row % 2) * pitchX / 2;
            const cv::Rect body(x, row * pitchY, pitchX - joint, pitchY - joint);
            cv::rectangle(p, body, colour, cv::FILLED);
            cv::rectangle(p, body - cv::Point(p.cols, 0), colour, cv::FILLED);  // wraps around
        }
    addGrain(p, 5, {3, 3}, 21);
    return {p, 9 * pitchX / 400.0};
}

TBuiltInTexture wood() {
    cv::Mat p = filled(512, 512, {70, 112, 158});
    addGrain(p, 7, {3, 201}, 31);
    addGrain(p, 4, {31, 301}, 32);
    return {p, 1.0};
}

TBuiltInTexture door() {  // a leaf of 0.9 m x 2.05 m at 256 px/m
    cv::Mat p;
    const cv::Rect whole(0, 0, 230, 525);
    cv::resize(wood().picture, p, whole.size(), 0, 0, cv::INTER_AREA);
    for (const cv::Rect panel : {cv::Rect(35, 40, 160, 190), cv::Rect(35, 285, 160, 195)}) {
        cv::rectangle(p, panel, {48, 80, 118}, 4, cv::LINE_AA);
        cv::rectangle(p, panel + cv::Point(3, 3), {92, 138, 186}, 1, cv::LINE_AA);
    }
    cv::rectangle(p, {202, 238, 18, 42}, {170, 175, 178}, cv::FILLED);  // plate
    cv::rectangle(p, {178, 250, 34, 8}, {120, 124, 128}, cv::FILLED);   // lever
    cv::circle(p, {211, 272}, 3, {30, 30, 30}, cv::FILLED, cv::LINE_AA);
    return {p, 0.9};
}

TBuiltInTexture metal() {  // ribs of a heater
    cv::Mat p = filled(400, 100, {214, 220, 222});
    for (int x = 0; x < 400; x += 20) {
        cv::rectangle(p, {x, 0, 5, 100}, {168, 174, 178}, cv::FILLED);
        cv::rectangle(p, {x + 5, 0, 3, 100}, {236, 240, 242}, cv::FILLED);
    }
    return {p, 1.0};
}

TBuiltInTexture notice() {  // a cork board with sheets of paper
    cv::Mat p = filled(512, 384, {96, 140, 178});
    addGrain(p, 12, {3, 3}, 41);
    CRandom random(7, "notice", 0);
    const auto pick = [&](int low, int high) {
        return low + static_cast<int>(random.bits() % static_cast<std::uint64_t>(high - low));
    };
    for (int i = 0; i < 8; ++i) {
        const cv::Rect sheet(20 + (i % 4) * 122 + pick(0, 18), 16 + (i / 4) * 180 + pick(0, 20),
                             pick(78, 100), pick(110, 150));
        const cv::Scalar paper(pick(150, 255), pick(190, 255), pick(200, 255));
        cv::rectangle(p, sheet, paper, cv::FILLED);
        cv::rectangle(p, {sheet.x + 8, sheet.y + 10, sheet.width - 16, 14},
                      {double(pick(0, 160)), double(pick(0, 120)), double(pick(0, 200))},
                      cv::FILLED);
        for (int y = sheet.y + 34; y < sheet.y + sheet.height - 10; y += 9)
            cv::line(p, {sheet.x + 8, y}, {sheet.x + sheet.width - pick(10, 40), y}, {60, 60, 60},
                     2);
    }
    return {p, 1.2};
}

TBuiltInTexture tiles() {
    cv::Mat p = filled(512, 512, {110, 122, 128});
    cv::rectangle(p, {0, 0, 256, 256}, {104, 115, 121}, cv::FILLED);
    cv::rectangle(p, {256, 256, 256, 256}, {104, 115, 121}, cv::FILLED);
    addGrain(p, 4, {5, 5}, 51);
    return {p, 1.0};
}

TBuiltInTexture panels() {  // of 0.6 m, one lamp to every fourth both ways
    cv::Mat p = filled(512, 512, {208, 212, 214});
    for (int i = 0; i < 512; i += 128) {
        cv::line(p, {i, 0}, {i, 511}, {180, 184, 186}, 2);
        cv::line(p, {0, i}, {511, i}, {180, 184, 186}, 2);
    }
    cv::rectangle(p, {134, 134, 116, 116}, {250, 252, 252}, cv::FILLED);
    return {p, 2.4};
}

TBuiltInTexture marker() {
    cv::Mat p = filled(512, 512, {235, 235, 235});
    cv::rectangle(p, {0, 0, 256, 256}, {20, 20, 20}, cv::FILLED);
    cv::rectangle(p, {256, 256, 256, 256}, {20, 20, 20}, cv::FILLED);
    return {p, 0.5};
}

void write(cv::Mat& p, const std::string& text, const cv::Point& at, double size, int grey) {
    cv::putText(p, text, at, cv::FONT_HERSHEY_SIMPLEX, size, cv::Scalar::all(grey),
                static_cast<int>(2 * size) + 1, cv::LINE_AA);
}

TBuiltInTexture exitSign() {  // who runs to a door, and the word
    cv::Mat p = filled(512, 256, {70, 140, 20});
    const cv::Scalar white(245, 250, 245);
    cv::rectangle(p, {8, 8, 496, 240}, white, 6);
    cv::rectangle(p, {30, 36, 96, 190}, white, cv::FILLED);
    cv::rectangle(p, {50, 52, 60, 174}, {70, 140, 20}, cv::FILLED);
    cv::circle(p, {196, 62}, 18, white, cv::FILLED, cv::LINE_AA);
    for (const auto& [a, b] : {std::pair{cv::Point(186, 88), cv::Point(170, 146)},
                               std::pair{cv::Point(186, 96), cv::Point(142, 112)},
                               std::pair{cv::Point(190, 96), cv::Point(226, 128)},
                               std::pair{cv::Point(170, 146), cv::Point(204, 176)},
                               std::pair{cv::Point(204, 176), cv::Point(188, 222)},
                               std::pair{cv::Point(170, 146), cv::Point(128, 196)}})
        cv::line(p, a, b, white, 15, cv::LINE_AA);
    write(p, "EXIT", {262, 118}, 3, 250);
    cv::arrowedLine(p, {470, 182}, {276, 182}, white, 18, cv::LINE_AA, 0, 0.25);
    return {p, 0.6};
}

TBuiltInTexture extinguisherSign() {
    cv::Mat p = filled(320, 384, {40, 30, 200});
    const cv::Scalar white(245, 245, 245);
    cv::rectangle(p, {8, 8, 304, 368}, white, 6);
    cv::rectangle(p, {60, 120, 84, 170}, white, cv::FILLED);
    cv::ellipse(p, {102, 120}, {42, 30}, 0, 180, 360, white, cv::FILLED, cv::LINE_AA);
    cv::rectangle(p, {92, 64, 20, 40}, white, cv::FILLED);
    cv::line(p, {102, 70}, {170, 52}, white, 12, cv::LINE_AA);
    cv::ellipse(p, {150, 170}, {34, 100}, 0, 270, 450, white, 9, cv::LINE_AA);
    for (int i = 0; i < 3; ++i)
        cv::ellipse(p, {250, 240 - 60 * i}, {34 - 6 * i, 46 - 6 * i}, 0, 0, 360, white,
                    i % 2 == 0 ? cv::FILLED : 6, cv::LINE_AA);
    write(p, "FIRE POINT", {40, 350}, 1.3, 250);
    return {p, 0.4};
}

TBuiltInTexture doorPlate() {  // the same on each door
    cv::Mat p = filled(384, 288, {225, 228, 230});
    cv::rectangle(p, {5, 5, 374, 278}, {70, 70, 70}, 5);
    cv::rectangle(p, {22, 22, 90, 90}, {130, 60, 20}, cv::FILLED);
    cv::circle(p, {67, 67}, 30, {240, 240, 240}, 8, cv::LINE_AA);
    write(p, "OFFICE", {130, 90}, 1.9, 20);
    write(p, "Please knock", {24, 160}, 1.4, 40);
    write(p, "Mo - Fr   9 - 17 h", {24, 210}, 1.1, 40);
    cv::rectangle(p, {24, 232, 336, 30}, {40, 40, 170}, cv::FILLED);
    for (int x = 40; x < 350; x += 34) cv::rectangle(p, {x, 238, 16, 18}, {240, 240, 240}, -1);
    return {p, 0.4};
}

using Painter = TBuiltInTexture (*)();
const std::vector<std::pair<std::string, Painter>> kPainters = {
    {"plaster", plaster}, {"brick", brick},   {"wood", wood},
    {"door", door},       {"plain", plain},   {"metal", metal},
    {"notice", notice},   {"tiles", tiles},   {"panels", panels},
    {"marker", marker},   {"exit", exitSign}, {"extinguisher", extinguisherSign},
    {"plate", doorPlate}};

}  // namespace

std::vector<std::string> textureNames() {
    std::vector<std::string> names;
    names.reserve(kPainters.size());
    for (const auto& painter : kPainters) names.push_back(painter.first);
    return names;
}

bool isBuiltInTexture(const std::string& name) {
    return std::any_of(kPainters.begin(), kPainters.end(),
                       [&](const auto& painter) { return painter.first == name; });
}

TBuiltInTexture paintTexture(const std::string& name) {
    for (const auto& painter : kPainters)
        if (painter.first == name) return painter.second();
    throw std::invalid_argument("'" + name + "' is not a built-in texture");
}

}  // namespace salma::simulator
