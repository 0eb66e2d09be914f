// SPDX-License-Identifier: BSD-3-Clause
#include "prints.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>

namespace salma::bench {
namespace {

void write(cv::Mat& on, const std::string& text, cv::Point at, double size, int thickness) {
    cv::putText(on, text, at, cv::FONT_HERSHEY_DUPLEX, size, cv::Scalar(40, 30, 30), thickness,
                cv::LINE_AA);
}

cv::Mat doorPlate(const std::string& number, const std::string& name) {
    cv::Mat plate(400, 600, CV_8UC3, cv::Scalar(225, 228, 230));
    cv::rectangle(plate, {12, 12}, {588, 388}, cv::Scalar(120, 120, 120), 6);
    write(plate, number, {60, 190}, 5, 10);
    write(plate, name, {60, 330}, 2.2, 5);
    return plate;
}

cv::Mat exitSign(bool toTheLeft) {
    cv::Mat sign(400, 800, CV_8UC3, cv::Scalar(70, 130, 20));
    const cv::Scalar white(245, 245, 245);
    cv::rectangle(sign, {520, 60}, {700, 340}, white, -1);  // a door
    cv::arrowedLine(sign, {460, 200}, {120, 200}, white, 50, cv::LINE_8, 0, 0.35);
    if (!toTheLeft) cv::flip(sign, sign, 1);
    return sign;
}

}  // namespace

cv::Mat cropped(const cv::Mat& print, double share) {
    const int cols = cvRound(share * print.cols), rows = cvRound(share * print.rows);
    return print({(print.cols - cols) / 2, (print.rows - rows) / 2, cols, rows}).clone();
}

cv::Mat ofSeries(const cv::Mat& picture) {
    cv::Mat poster(900, 640, CV_8UC3, cv::Scalar(235, 240, 240));
    poster.rowRange(0, 130).setTo(cv::Scalar(120, 60, 30));
    cv::putText(poster, "MUSEUM OF ART", {40, 90}, cv::FONT_HERSHEY_DUPLEX, 2.1,
                cv::Scalar(240, 240, 240), 4, cv::LINE_AA);
    cv::Mat inside = poster(cv::Rect(70, 180, 500, 520));
    cv::resize(picture, inside, inside.size(), 0, 0, cv::INTER_AREA);
    cv::rectangle(poster, {62, 172}, {577, 707}, cv::Scalar(60, 60, 60), 5);
    write(poster, "Autumn exhibition", {70, 770}, 1.5, 3);
    write(poster, "daily 10 to 18, free entrance", {70, 830}, 0.95, 2);
    write(poster, "1", {560, 870}, 1, 2);
    return poster;
}

std::vector<cv::Mat> plainSigns() {
    return {doorPlate("2.14", "Stores"),
            doorPlate("2.16", "Office"),
            doorPlate("3.14", "Stores"),
            doorPlate("1.07", "Library"),
            exitSign(true),
            exitSign(false)};
}

void hide(TPosterView& view, double share) {
    const auto& r = view.place;
    const double from = r.u0 + (1 - share) * (r.u1 - r.u0);
    std::vector<cv::Point> outline;
    for (const auto& [u, v] : {std::pair(from, r.v0), std::pair(r.u1, r.v0), std::pair(r.u1, r.v1),
                               std::pair(from, r.v1)}) {
        const auto p = *view.truth.toPixel(u, v);
        outline.emplace_back(cvRound(p.x), cvRound(p.y));
    }
    cv::Mat mask = cv::Mat::zeros(view.grey.size(), CV_8U);
    cv::fillConvexPoly(mask, outline, cv::Scalar(255));
    cv::Mat somebody(view.grey.size(), CV_8U, cv::Scalar(60));
    const int half = (outline[0].y + outline[2].y) / 2;
    somebody.rowRange(std::clamp(half, 0, somebody.rows), somebody.rows).setTo(110);
    somebody.copyTo(view.grey, mask);
}

}  // namespace salma::bench
