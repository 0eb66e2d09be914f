// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/appearance/CPatchMatcher.h>
#include <salma/appearance/CTexture.h>

#include <algorithm>
#include <cmath>

#include "CAgreement.h"
#include "lengthErrors.h"
#include "likelihoodTable.h"
#include "matchKeypoints.h"
#include "matchRegions.h"

namespace salma::appearance {
namespace {

constexpr double kOpposite = mrpt::DEG2RAD(130.0);  // 65 deg to either side
// Highest score beside plenty of keypoints, as a line over the keypoint score. Equal prints stay
// below it; prints that are only laid out alike would not.
constexpr double kRegionsAlone = 0.2, kWithKeypoints = 2;

/// Direction of the robot from the patch, 0 straight in front of it [rad].
double viewOf(const observations::TPatch& patch) {
    const auto& pose = patch.pose.mean;
    return mrpt::math::wrapToPi(std::atan2(-pose.y(), -pose.x()) - (pose.yaw() - M_PI_2));
}

bool hasPose(const observations::TPatch& patch) {
    const auto& p = patch.pose.mean;
    return std::isfinite(p.x() + p.y() + p.z() + p.yaw() + p.pitch() + p.roll()) &&
           patch.pose.cov.asEigen().allFinite();
}

/// Regions are comparable where both rectangles are nearly the same piece of wall: their contrast
/// is that of the whole rectangle, and an extent gone wrong shows other regions.
bool comparable(const observations::TPatch& a, const observations::TPatch& b, double least) {
    const double common = std::min(a.width, b.width) * std::min(a.height, b.height);
    return !a.regions.empty() && !b.regions.empty() &&
           common >= least * std::max(a.width * a.height, b.width * b.height);
}

std::vector<TPointPair> centres(const observations::TPatch& a,
                                const observations::TPatch& b,
                                const std::vector<std::pair<std::size_t, std::size_t>>& pairs) {
    std::vector<TPointPair> out;
    out.reserve(pairs.size());
    for (const auto& [i, j] : pairs)
        out.push_back({a.regions[i].x, a.regions[i].y, b.regions[j].x, b.regions[j].y});
    return out;
}

/// From the pairs; patches without a place in the robot's frame have no shared errors to add.
std::optional<TRelativePose> relativeOf(const observations::TPatch& a,
                                        const observations::TPatch& b,
                                        const std::vector<TPointPair>& pairs) {
    auto pose = relativePose(pairs);
    const auto placed = [](const observations::TPatch& patch) {
        return std::hypot(patch.pose.mean.x(), patch.pose.mean.y()) > 0;
    };
    if (pose && placed(a) && placed(b))
        addPatchErrors(pairs, metricErrors(a), metricErrors(b), *pose);
    return pose;
}

}  // namespace

void TRegionMatchOptions::visit(config::COptionVisitor& v) {
    using namespace config;
    v.number("place_sigma_m", placeSigma, moreThan(0), "noise of a region's centre, beside");
    v.number("place_sigma_scales", placeSigmaScales, atLeast(0), "this, times its radius");
    v.number("log_scale_sigma", logScaleSigma, moreThan(0), "noise of the logarithm of a radius");
    v.number("gate_quantile", gateQuantile, insideOf(0, 1),
             "probability that a true pair passes the gate");
    v.number("max_shift_m", maxShift, moreThan(0), "largest common shift along each axis");
    v.number("strong", strong, between(0.01, 1),
             "share of a patch's regions, the most salient, that counts");
    v.number("correlation", correlation, between(-1, 1), "from which two regions look alike");
    v.number("same_extent", sameExtent, between(0, 1),
             "regions are compared if the smaller extent is this share of the larger");
    v.number("support", support, between(0, 1),
             "share of regions that must look alike before place alone counts");
}

void TMatcherOptions::visit(config::COptionVisitor& v) {
    using namespace config;
    v.number("ratio", ratio, insideOf(0, 1), "nearest over second nearest descriptor distance");
    v.number("scale_tolerance", scaleTolerance, moreThan(1), "patches agree in scale within it");
    v.degrees("rotation_tolerance_deg", rotationTolerance, insideOf(0, 90),
              "patches agree in rotation within it");
    v.number("position_tolerance_m", positionTolerance, moreThan(0),
             "matches agree on the similarity within this");
    v.integer("min_matches", minMatches, atLeast(2), "fewer consistent matches score 0");
    v.integer("full_score_keypoints", fullScoreKeypoints, atLeast(1),
              "a patch with fewer keypoints cannot score 1");
    v.number("regions_same_view", regionsSameView, between(0, 1),
             "region score from which regions agree, for two views from one side");
    v.number("regions_opposite_view", regionsOppositeView, between(0, 1),
             "the same for views 130 deg apart; in between it falls evenly");
    v.number("duplicate_rate", duplicateRate, insideOf(0, 1),
             "share of other entities that look the same");
    v.numbers("score_knots", scoreKnots, between(0, 1), "ascending scores of the table");
    v.numbers("log_lr_knots", logLrKnots, anyNumber(),
              "log p(score|same) / p(score|other) at each, learned from simulated runs");
    v.numbers("keypoint_score_knots", keypointScoreKnots, between(0, 1),
              "the same for patches without regions");
    v.numbers("keypoint_log_lr_knots", keypointLogLrKnots, anyNumber(), "and the ratios at each");
}

void TMatcherOptions::validate() const {
    checkTable(scoreKnots, logLrKnots, "matcher");
    checkTable(keypointScoreKnots, keypointLogLrKnots, "matcher");
}

CPatchMatcher::CPatchMatcher(const TMatcherOptions& options,
                             const TRegionMatchOptions& regionOptions)
    : m_options(options), m_regionOptions(regionOptions) {
    m_options.validate();
    m_regionOptions.validate();
}

double CPatchMatcher::logLikelihoodRatio(double score, EEvidence evidence) const {
    if (evidence == EEvidence::none) return 0;
    const bool both = evidence == EEvidence::both;
    const double table =
        readTable(both ? m_options.scoreKnots : m_options.keypointScoreKnots,
                  both ? m_options.logLrKnots : m_options.keypointLogLrKnots, score);
    return withDuplicates(table, m_options.duplicateRate);
}

void CPatchMatcher::matchKeypointsOf(const observations::TPatch& a,
                                     const observations::TPatch& b,
                                     TPatchMatch& out) const {
    const auto putative = matchKeypoints(a.keypoints, b.keypoints, m_options.ratio);
    out.putative = putative.size();
    const CAgreement agreement(m_options, a.keypoints, b.keypoints);
    out.keypoints = agreement.agreeing(putative);
    if (out.keypoints.size() < static_cast<std::size_t>(m_options.minMatches)) return;
    const std::size_t fewer = std::min(a.keypoints.size(), b.keypoints.size());
    const auto full = static_cast<std::size_t>(m_options.fullScoreKeypoints);
    out.keypointScore =
        static_cast<double>(out.keypoints.size()) / static_cast<double>(std::max(fewer, full));
    out.relative = relativeOf(a, b, agreement.points(out.keypoints));
}

void CPatchMatcher::matchRegionsOf(const observations::TPatch& a,
                                   const observations::TPatch& b,
                                   TPatchMatch& out) const {
    auto agreement = matchRegions(m_regionOptions, a, b);
    out.regionScore = agreement.score;
    out.regions = std::move(agreement.pairs);
    const double apart = std::min(1.0, out.viewDifference / kOpposite);
    const double demanded =
        m_options.regionsSameView * (1 - apart) + m_options.regionsOppositeView * apart;
    out.regionsAgree = out.regionScore >= demanded;
    if (!out.relative && out.regionsAgree)
        out.relative = relativeOf(a, b, centres(a, b, out.regions));
}

TPatchMatch CPatchMatcher::match(const observations::TPatch& a,
                                 const observations::TPatch& b) const {
    TPatchMatch out;
    if (!hasPose(a) || !hasPose(b)) return out;
    out.viewDifference = std::abs(mrpt::math::wrapToPi(viewOf(a) - viewOf(b)));
    out.textureDistance = textureDistance(a.texture, b.texture);
    const std::size_t fewer = std::min(a.keypoints.size(), b.keypoints.size());
    const bool telling = fewer >= static_cast<std::size_t>(m_options.minMatches);
    if (telling) matchKeypointsOf(a, b, out);
    const bool withRegions = comparable(a, b, m_regionOptions.sameExtent);
    if (withRegions) matchRegionsOf(a, b, out);
    out.score = withRegions ? (out.keypointScore + out.regionScore) / 2 : out.keypointScore;
    // Plenty of keypoints and hardly one agrees: laid out alike, as mirrored, no more.
    if (fewer >= static_cast<std::size_t>(m_options.fullScoreKeypoints))
        out.score = std::min(out.score, kRegionsAlone + kWithKeypoints * out.keypointScore);
    if (telling) out.evidence = withRegions ? EEvidence::both : EEvidence::keypoints;
    out.logLikelihoodRatio = logLikelihoodRatio(out.score, out.evidence);
    return out;
}

bool saysEnough(const observations::TPatch& patch, std::size_t minKeypoints) {
    const std::size_t keypoints = patch.keypoints.size();
    return keypoints >= minKeypoints ||
           (2 * keypoints >= minKeypoints && patch.regions.size() >= minKeypoints);
}

}  // namespace salma::appearance
