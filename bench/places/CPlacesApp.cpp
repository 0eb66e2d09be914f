// SPDX-License-Identifier: BSD-3-Clause
#include "CPlacesApp.h"

#include <salma/laser/CPlaceFilter.h>

#include <array>
#include <fstream>
#include <iomanip>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "CConfusion.h"
#include "CProgressBar.h"
#include "TPlaceSample.h"
#include "parallelFor.h"
#include "revisitFigures.h"
#include "stringFigures.h"
#include "trainNetwork.h"
#include "writeModel.h"

namespace salma::bench {
namespace {

using laser::EPlaceClass;
using laser::mostLikely;
using laser::TPlaceVector;

constexpr std::size_t kTrainingPoses = 30;  // of each class and building
constexpr std::size_t kTestPoses = 20;
constexpr std::size_t kWalkSteps = 1500;

simulator::TBuildingOptions buildingsNamed(const std::string& name) {
    if (name == "training") return trainingBuildings();
    if (name == "validation") return validationBuildings();
    return testBuildings();
}

/// make(seed) for `count` buildings, in order of their seeds.
template <class MAKE>
auto forBuildings(std::uint32_t seed, int count, int threads, const MAKE& make) {
    std::vector<decltype(make(seed))> all(static_cast<std::size_t>(count));
    apps::CProgressBar progress("buildings", all.size());
    apps::parallelFor(all.size(), threads, [&](std::size_t i) {
        all[i] = make(seed + static_cast<std::uint32_t>(i));
        progress.step();
    });
    return all;
}

/// Shares of the classes a step later, as if each had been seen once after each.
laser::TPlaceTransitions transitionsOf(const std::vector<std::vector<TPlaceStep>>& walks) {
    laser::TPlaceTransitions result;
    for (auto* matrix : {&result.goingOn, &result.turning}) {
        const bool turning = matrix == &result.turning;
        for (auto& row : *matrix) row.fill(1);
        for (const auto& walk : walks)
            for (const TPlaceStep& s : walk)
                if ((s.step == laser::EPlaceStep::turning) == turning)
                    ++(*matrix)[static_cast<std::size_t>(s.from)][static_cast<std::size_t>(s.to)];
        for (auto& row : *matrix) {
            const double sum = std::accumulate(row.begin(), row.end(), 0.0);
            for (double& n : row) n /= sum;
        }
    }
    return result;
}

void print(const std::string& what, const CConfusion& confusion, std::ostream& out) {
    const auto accuracy = confusion.balancedAccuracy();
    out << std::fixed << std::setprecision(2) << what << ": balanced accuracy "
        << 100 * accuracy.value << " % (95 %: " << 100 * accuracy.low << " to "
        << 100 * accuracy.high << "), " << confusion.total() << " poses\n"
        << std::defaultfloat;
}

}  // namespace

CPlacesApp::CPlacesApp(CLI::App& app) {
    app.require_subcommand(1);
    m_train = app.add_subcommand("train", "fits the classifier and writes placeModel.cpp");
    m_train->add_option("--out", m_out, "the file")->required();
    m_test = app.add_subcommand("test", "single scans in buildings that training has not seen");
    m_walk = app.add_subcommand("walk", "scans of wandering robots, with and without the filter");
    m_walk->add_option("--evidence", m_evidence, "of the filter (default 1)");
    m_walk->add_option("--surprise", m_surprise, "of the filter (default 0.3)");
    m_strings =
        app.add_subcommand("strings", "distances of place strings, of one place and others");
    m_revisit = app.add_subcommand("revisit", "P(outside the map) in half-mapped buildings");
    m_revisit->add_option("--plot", m_plot, "picture to draw");
    m_revisit->add_option("--evidence", m_revisitOptions.evidence, "of the model");
    m_revisit->add_option("--enter", m_revisitOptions.enter, "of the model");
    m_revisit->add_option("--leave", m_revisitOptions.leave, "of the model");
    m_strip = app.add_subcommand("strip", "draws the classes along the way of a real log");
    m_strip->add_option("LOG", m_stripOptions.log, "CARMEN log with corrected poses")->required();
    m_strip->add_option("--out", m_stripOptions.picture, "picture to draw")->required();
    m_strip->add_option("--first", m_stripOptions.first, "scan to begin with (default 0)")
        ->check(CLI::Range(0, 100000000));
    m_strip->add_option("--count", m_stripOptions.count, "how many (default: to the end)")
        ->check(CLI::Range(1, 100000000));
    for (CLI::App* command : {m_test, m_walk, m_strings, m_revisit})
        command->add_option("--kind", m_buildings, "training, validation or test (default)")
            ->check(CLI::IsMember({"training", "validation", "test"}));
    for (CLI::App* command : {m_train, m_test, m_walk, m_strings, m_revisit}) {
        command->add_option("--buildings", m_count, "how many (default: 240, 60, 30, 20, 30)")
            ->check(CLI::Range(1, 100000));
        command->add_option("--seed", m_seed, "of the first (default: 1, 9001, 9701, 9001, 9801)");
        command->add_option("--threads", m_threads, "threads (default 0: one per core)")
            ->check(CLI::Range(0, 1024));
    }
}

void CPlacesApp::run(std::ostream& out) {
    if (m_train->parsed()) train(out);
    if (m_test->parsed()) test(out);
    if (m_walk->parsed()) walk(out);
    if (m_strings->parsed()) strings(out);
    if (m_revisit->parsed()) revisit(out);
    if (m_strip->parsed()) drawStrip(m_stripOptions, out);
}

void CPlacesApp::train(std::ostream& out) const {
    const int count = m_count > 0 ? m_count : 240;
    const std::uint32_t seed = m_seed > 0 ? m_seed : 1;
    struct TExample {
        laser::TPlaceFeatures features;
        std::vector<EPlaceClass> places;  // two on the approach to a place, else one
    };
    const auto buildings = forBuildings(seed, count, m_threads, [](std::uint32_t s) {
        std::vector<TExample> examples;
        for (const auto& sample : drawSamples(trainingBuildings(), s, kTrainingPoses)) {
            const auto features = laser::CPlaceClassifier::features(sample.scan);
            std::vector<EPlaceClass> places = sample.truth.either;
            if (sample.truth.place) places = {*sample.truth.place};
            if (features && !places.empty()) examples.push_back({*features, places});
        }
        return examples;
    });
    Eigen::Index samples = 0, column = 0;
    for (const auto& examples : buildings)
        samples += 2 * static_cast<Eigen::Index>(examples.size());
    Eigen::MatrixXf features(static_cast<Eigen::Index>(laser::CPlaceClassifier::numberOfFeatures()),
                             samples);
    Eigen::MatrixXf targets = Eigen::MatrixXf::Zero(laser::kPlaceClasses, samples);
    for (const auto& examples : buildings)
        for (const auto& e : examples) {
            features.col(column) = e.features.asSeen;
            features.col(column + 1) = e.features.mirrored;
            const float share = 1.0F / static_cast<float>(e.places.size());
            for (const EPlaceClass place : e.places) {
                targets(static_cast<Eigen::Index>(place), column) = share;
                targets(static_cast<Eigen::Index>(mirrored(place)), column + 1) = share;
            }
            column += 2;
        }
    out << samples << " samples from " << count << " buildings\n";
    const auto network = trainNetwork(features, targets, {}, out);
    const auto walks = forBuildings(seed, count, m_threads, [](std::uint32_t s) {
        return stepsOfWalk(trainingBuildings(), s, kWalkSteps);
    });
    std::ofstream file(m_out);
    writeModel(network, transitionsOf(walks), file);
    if (!file.flush()) throw std::runtime_error(m_out + ": cannot be written");
}

void CPlacesApp::test(std::ostream& out) const {
    const auto options = buildingsNamed(m_buildings);
    const laser::CPlaceClassifier classifier;
    const auto buildings =
        forBuildings(m_seed > 0 ? m_seed : 9001, m_count > 0 ? m_count : 60, m_threads,
                     [&](std::uint32_t s) { return drawSamples(options, s, kTestPoses); });
    CConfusion confusion;
    std::array<std::size_t, simulator::kPlaceDoubts> doubts{};
    std::size_t approaching = 0, either = 0;
    for (const auto& samples : buildings)
        for (const auto& sample : samples) {
            const auto p = classifier.classify(sample.scan);
            if (!p) throw std::runtime_error("a scan could not be judged");
            ++doubts[static_cast<std::size_t>(sample.truth.doubt)];
            const EPlaceClass answer = mostLikely(*p);
            if (sample.truth.place) confusion.add(sample.building, *sample.truth.place, answer);
            if (sample.truth.doubt != simulator::EPlaceDoubt::approach) continue;
            ++approaching;
            for (const EPlaceClass good : sample.truth.either) either += good == answer ? 1 : 0;
        }
    print("single scans", confusion, out);
    confusion.write(out);
    out << "left out:";
    for (std::size_t i = 1; i < doubts.size(); ++i)
        out << ' ' << asString(static_cast<simulator::EPlaceDoubt>(i)) << ' ' << doubts[i] << ';';
    out << "\non approach one of the two classes was said in " << either << " of " << approaching
        << '\n';
}

void CPlacesApp::walk(std::ostream& out) const {
    const auto options = buildingsNamed(m_buildings);
    const laser::CPlaceClassifier classifier;
    laser::TPlaceFilterOptions filterOptions;
    filterOptions.evidence = m_evidence;
    filterOptions.surprise = m_surprise;
    const auto buildings =
        forBuildings(m_seed > 0 ? m_seed : 9701, m_count > 0 ? m_count : 30, m_threads,
                     [&](std::uint32_t s) { return drawWalk(options, s, kWalkSteps); });
    CConfusion single, filtered;
    std::size_t steps = 0;
    for (const auto& walk : buildings) {
        laser::CPlaceFilter filter(filterOptions);
        for (const auto& sample : walk) {
            ++steps;
            const auto p = classifier.classify(sample.scan);
            const TPlaceVector belief =
                p ? filter.update(*p, sample.step) : filter.skip(sample.step);
            if (!sample.truth.place || !p) continue;
            single.add(sample.building, *sample.truth.place, mostLikely(*p));
            filtered.add(sample.building, *sample.truth.place, mostLikely(belief));
        }
    }
    out << steps << " steps\n";
    print("single scans", single, out);
    single.write(out);
    print("with the filter", filtered, out);
    filtered.write(out);
}

void CPlacesApp::strings(std::ostream& out) const {
    writeStringFigures(buildingsNamed(m_buildings), m_seed > 0 ? m_seed : 9001,
                       m_count > 0 ? m_count : 20, out);
}

void CPlacesApp::revisit(std::ostream& out) const {
    const auto prior = priorOfBuildings(trainingBuildings(), 1, 40);
    TRevisitTrial trial;
    trial.options = m_revisitOptions;
    const auto buildings = forBuildings(
        m_seed > 0 ? m_seed : 9801, m_count > 0 ? m_count : 30, m_threads, [&](std::uint32_t s) {
            return walkHalfMapped(buildingsNamed(m_buildings), s, prior, trial);
        });
    std::vector<TRevisitStep> steps;
    for (const auto& some : buildings) steps.insert(steps.end(), some.begin(), some.end());
    writeRevisitFigures(steps, out);
    if (!m_plot.empty()) plotRevisit(steps, m_plot);
}

}  // namespace salma::bench
