// SPDX-License-Identifier: BSD-3-Clause
#include "CCalibration.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <stdexcept>

namespace salma::apps {
namespace {

using appearance::CPatchMatcher;
using appearance::EEvidence;

void checkFolders(const std::vector<std::string>& learning,
                  const std::vector<std::string>& report) {
    std::set<std::filesystem::path> known;
    for (const auto* list : {&learning, &report})
        for (const auto& folder : *list) {
            if (!std::filesystem::is_directory(folder))
                throw std::runtime_error(folder + ": no such folder");
            if (!known.insert(std::filesystem::canonical(folder)).second)
                throw std::invalid_argument(folder + ": is named twice");
        }
    if (known.size() < 2)
        throw std::invalid_argument(learning.at(0) +
                                    ": one run alone says nothing about others: name more runs, "
                                    "or one with other pictures behind --report");
}

std::set<std::string> texturesOf(const TRunSet& set) {
    std::set<std::string> textures;
    for (const auto& run : set.runs)
        for (const auto& seen : run.seen) textures.insert(seen.texture);
    return textures;
}

std::string namesOf(const TRunSet& set) {
    std::string names;
    for (const auto& run : set.runs) names += (names.empty() ? "" : ", ") + run.folder;
    return names;
}

void countPairs(TRunSet& set) {
    for (const auto& pairs : set.pairs)
        for (const auto& pair : pairs) {
            if (pair.evidence == EEvidence::none)
                ++set.counts.silent;
            else if (pair.kind == EPair::same)
                ++set.counts.same;
            else if (pair.kind == EPair::other)
                ++set.counts.other;
            else
                ++set.counts.duplicate;
        }
    if (set.counts.same == 0)
        throw std::invalid_argument(namesOf(set) + ": no poster was seen twice in one run");
    if (set.counts.other == 0)
        throw std::invalid_argument(namesOf(set) +
                                    ": no two different posters were seen in one run");
}

/// Scores of one kind of pair; `scoreOf` returns a negative number for pairs to be left out.
template <class SCORE>
std::vector<double> scores(const TRunSet& set, EPair kind, const SCORE& scoreOf) {
    std::vector<double> result;
    for (const auto& pairs : set.pairs)
        for (const auto& pair : pairs) {
            const double score = pair.kind == kind ? scoreOf(pair) : -1;
            if (score >= 0) result.push_back(score);
        }
    return result;
}

template <class RATIO>
std::vector<TJudgedPair> judged(const TRunSet& set, bool withDuplicates, const RATIO& ratioOf) {
    std::vector<TJudgedPair> result;
    for (const auto& pairs : set.pairs)
        for (const auto& pair : pairs)
            if (pair.evidence != EEvidence::none &&
                (withDuplicates || pair.kind != EPair::duplicate))
                result.push_back(
                    {ratioOf(pair), pair.kind == EPair::same, pair.textureA, pair.textureB});
    return result;
}

}  // namespace

CCalibration::CCalibration(const TCalibrationOptions& options, const TSlamConfig& config)
    : m_options(options), m_config(config) {
    m_options.validate();
}

TRunSet CCalibration::load(const std::vector<std::string>& folders) const {
    const CPatchMatcher matcher(m_config.matcher, m_config.regionMatcher);
    TRunSet set;
    for (const auto& folder : folders) {
        set.runs.push_back(labelRun(folder, m_config));
        set.pairs.push_back(comparePairs(set.runs.back(), matcher, m_config.run.threads));
    }
    set.posters = texturesOf(set).size();
    countPairs(set);
    return set;
}

/// Views of one poster resemble each other in what they score: however many there are, they are
/// worth no more than `perPoster`.
TIndependent CCalibration::worthOf(const TRunSet& set) const {
    std::set<std::pair<std::string, std::string>> same, other;
    for (const auto& pairs : set.pairs)
        for (const auto& pair : pairs) {
            const auto key = std::minmax(pair.textureA, pair.textureB);
            if (pair.kind == EPair::same) same.insert(key);
            if (pair.kind == EPair::other) other.insert(key);
        }
    return {m_options.perPoster * static_cast<double>(same.size()),
            m_options.perPoster * static_cast<double>(other.size())};
}

void CCalibration::learn(TCalibration& calibration) const {
    const TRunSet& set = calibration.learning;
    const TIndependent independent = worthOf(set);
    const auto ofBoth = [](const TLabelledPair& pair) {
        return pair.evidence == EEvidence::both ? pair.score : -1;
    };
    const auto ofKeypoints = [](const TLabelledPair& pair) {
        return pair.evidence == EEvidence::none ? -1 : pair.keypointScore;
    };
    const auto same = scores(set, EPair::same, ofBoth), other = scores(set, EPair::other, ofBoth);
    if (same.empty() || other.empty())
        throw std::invalid_argument(namesOf(set) + ": no pairs of " +
                                    (same.empty() ? "one poster" : "different posters") +
                                    " whose regions can be compared");
    calibration.both = learnTable(same, other, independent, m_options);
    calibration.keypoints =
        learnTable(scores(set, EPair::same, ofKeypoints), scores(set, EPair::other, ofKeypoints),
                   independent, m_options);

    const auto logRatio = [&](const TLabelledPair& pair) {
        if (pair.evidence == EEvidence::none) return 0.0;
        return readRatio(
            pair.evidence == EEvidence::both ? calibration.both : calibration.keypoints,
            pair.score);
    };
    calibration.duplicates = duplicateRate(
        set.runs, set.pairs, [&](const TLabelledPair& pair) { return std::exp(logRatio(pair)); });
    calibration.decorrelated = decorrelation(set.runs, set.pairs, logRatio, m_options);
    calibration.detected = detection(set.runs);
    calibration.detection = learnDetection(set.runs, m_config.detection, m_options);

    calibration.matcher = m_config.matcher;
    calibration.matcher.scoreKnots = calibration.both.scoreKnots;
    calibration.matcher.logLrKnots = calibration.both.logLrKnots;
    calibration.matcher.keypointScoreKnots = calibration.keypoints.scoreKnots;
    calibration.matcher.keypointLogLrKnots = calibration.keypoints.logLrKnots;
    calibration.matcher.duplicateRate =
        std::max(1.0, std::round(calibration.duplicates.rate * 1000)) / 1000;
    calibration.matcher.validate();
}

void CCalibration::judge(const TCalibration& calibration, TRunSet& set) const {
    const CPatchMatcher matcher(calibration.matcher, m_config.regionMatcher);
    const auto learned = [&](const TLabelledPair& pair) {
        return matcher.logLikelihoodRatio(pair.score, pair.evidence);
    };
    set.learned = reliability(judged(set, true, learned));
    set.configured = reliability(
        judged(set, true, [](const TLabelledPair& pair) { return pair.configuredRatio; }));
    const auto lossOf = [&](association::ELandmarkKind kind) {
        return detectionLoss(set.runs, kind, calibration.detection, m_config.detection);
    };
    set.posterDetection = lossOf(association::ELandmarkKind::salient);
    set.cornerDetection = lossOf(association::ELandmarkKind::corner);
    set.areaWithoutDuplicates = reliability(judged(set, false, learned)).areaUnderCurve.value;
}

TCalibration CCalibration::run(const std::vector<std::string>& learning,
                               const std::vector<std::string>& report) const {
    checkFolders(learning, report);
    TCalibration calibration;
    calibration.learning = load(learning);
    if (!report.empty()) {
        calibration.report = load(report);
        const auto known = texturesOf(calibration.learning);
        for (const auto& texture : texturesOf(*calibration.report))
            if (known.count(texture) != 0)
                throw std::invalid_argument(namesOf(*calibration.report) + ": " + texture +
                                            " hangs in the learning runs too, so these are not "
                                            "held out");
    } else {
        calibration.notices.push_back(
            "no --report: the figures are those of the runs that were learned from");
    }
    learn(calibration);
    if (calibration.learning.counts.duplicate == 0)
        calibration.notices.push_back(
            "no picture hangs twice in the learning runs: duplicate_rate is a prior");
    if (!calibration.decorrelated.angle)
        calibration.notices.push_back(
            "the correlation of successive views does not fall to the limit");
    judge(calibration, calibration.learning);
    if (calibration.report) judge(calibration, *calibration.report);
    return calibration;
}

}  // namespace salma::apps
