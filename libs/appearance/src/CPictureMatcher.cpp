// SPDX-License-Identifier: BSD-3-Clause
#include <salma/appearance/CPictureMatcher.h>

#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <stdexcept>

#include "likelihoodTable.h"
#include "matchKeypoints.h"

namespace salma::appearance {
namespace {

constexpr std::size_t kFewest = 8;      // agreeing pairs; a homography through any four is exact
constexpr int kIterations = 5000;       // of RANSAC
constexpr double kConfidence = 0.9999;  // of having drawn four good pairs

/// Pixel of a keypoint that is measured from the picture's centre with y up.
cv::Point2d pixelOf(const observations::TKeypoint& k, const cv::Mat& picture) {
    return {k.x + (picture.cols - 1) / 2.0, (picture.rows - 1) / 2.0 - k.y};
}

/// True if H turns a picture over around the given place, as no view of a wall does.
bool mirrors(const cv::Matx33d& H, const cv::Point2d& at) {
    const double w = H(2, 0) * at.x + H(2, 1) * at.y + H(2, 2);
    // sign of the Jacobian's determinant: det(H) / w^3
    return !(cv::determinant(H) * w > 0);
}

}  // namespace

void TPictureMatcherOptions::visit(config::COptionVisitor& v) {
    using namespace config;
    v.integer("max_keypoints", maxKeypoints, between(4, 5000), "the strongest of each picture");
    v.number("ratio", ratio, insideOf(0, 1), "nearest over second nearest descriptor distance");
    v.number("tolerance_px", tolerance, moreThan(0), "pairs agree on a homography within this");
    v.integer("min_keypoints", minKeypoints, atLeast(4), "a picture with fewer says nothing");
    v.integer("full_score_matches", fullScoreMatches, atLeast(4),
              "with fewer putative pairs the score cannot reach 1");
    v.number("duplicate_rate", duplicateRate, insideOf(0, 1),
             "share of other planes that look the same");
    v.number("decide_same_log_lr", decideSame, anyNumber(), "from here the decision is same");
    v.number("decide_other_log_lr", decideOther, anyNumber(), "up to here it is other");
    v.numbers("score_knots", scoreKnots, between(0, 1), "ascending scores of the table");
    v.numbers("log_lr_knots", logLrKnots, anyNumber(), "log likelihood ratio at each");
}

void TPictureMatcherOptions::validate() const {
    checkTable(scoreKnots, logLrKnots, "picture_matcher");
    if (!(decideOther < decideSame))
        throw std::invalid_argument(
            "[picture_matcher] decide_other_log_lr must be below decide_same_log_lr");
}

const char* asString(EDecision decision) {
    switch (decision) {
        case EDecision::same:
            return "same";
        case EDecision::other:
            return "other";
        case EDecision::unknown:
            break;
    }
    return "unknown";
}

CPictureMatcher::CPictureMatcher(const TPictureMatcherOptions& options) : m_options(options) {
    m_options.validate();
}

TPictureMatch CPictureMatcher::match(const cv::Mat& a, const cv::Mat& b) const {
    TDescriptorOptions describe;
    describe.maxKeypoints = m_options.maxKeypoints;
    const CPatchDescriptor descriptor(describe);
    const auto keysA = descriptor.describe(a, 1);
    const auto keysB = descriptor.describe(b, 1);
    TPictureMatch out;
    if (std::min(keysA.size(), keysB.size()) < static_cast<std::size_t>(m_options.minKeypoints))
        return out;
    std::vector<cv::Point2d> from, to;
    for (const auto& pair : matchKeypoints(keysA, keysB, m_options.ratio)) {
        from.push_back(pixelOf(keysA[pair.first], a));
        to.push_back(pixelOf(keysB[pair.second], b));
    }
    out.putative = from.size();
    std::vector<unsigned char> agrees(from.size(), 0);
    cv::Mat H;
    if (from.size() >= kFewest)
        H = cv::findHomography(from, to, cv::RANSAC, m_options.tolerance, agrees, kIterations,
                               kConfidence);
    if (!H.empty()) {
        out.homography = H;
        for (std::size_t i = 0; i < from.size(); ++i)
            if (agrees[i] && !mirrors(out.homography, from[i]))
                out.pairs.push_back({{from[i].x, from[i].y}, {to[i].x, to[i].y}});
    }
    if (out.pairs.size() >= kFewest)
        out.score = static_cast<double>(out.pairs.size()) /
                    std::max<double>(m_options.fullScoreMatches, static_cast<double>(from.size()));
    out.logLikelihoodRatio = withDuplicates(
        readTable(m_options.scoreKnots, m_options.logLrKnots, out.score), m_options.duplicateRate);
    if (out.logLikelihoodRatio >= m_options.decideSame) out.decision = EDecision::same;
    if (out.logLikelihoodRatio <= m_options.decideOther) out.decision = EDecision::other;
    return out;
}

}  // namespace salma::appearance
