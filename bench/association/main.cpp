// SPDX-License-Identifier: BSD-3-Clause
// Processor time, nodes and right pairings of JCBB, salma's against MRPT's, as the table of
// docs/association.md.
#include <salma/association/CDataAssociator.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <string>

#include "TScene.h"
#include "mrptJcbb.h"

namespace {

using namespace salma;

struct TArguments {
    std::uint32_t seeds{50};
    std::uint32_t mrptSeeds{5};
    double mrptLimit{20};
};

/// Sums over the seeds of one row.
struct TScore {
    std::vector<double> milliseconds;
    std::vector<double> nodes;
    std::size_t right{0}, wrong{0}, seen{0};
    std::size_t stopped{0};  //!< Runs that hit a limit.

    void add(const std::vector<int>& landmarks, const std::vector<int>& truth) {
        for (std::size_t i = 0; i < truth.size(); ++i) {
            ++seen;
            if (landmarks[i] == truth[i])
                ++right;
            else if (landmarks[i] >= 0)
                ++wrong;
        }
    }
};

double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

void addOurs(const bench::TScene& scene, association::EMethod method, TScore& score) {
    association::TAssociationOptions options;
    options.method = method;
    const auto associator = association::createAssociator(options);
    const std::clock_t start = std::clock();
    const auto result = associator->associate(scene.problem);
    const double time = 1000. * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    std::vector<int> landmarks;
    for (const auto& decision : result.decisions) landmarks.push_back(decision.landmark);
    score.add(landmarks, scene.truth);
    score.milliseconds.push_back(time);
    score.nodes.push_back(static_cast<double>(result.search.nodes));
    score.stopped += !result.search.complete;
}

void addMrpt(const bench::TScene& scene, double limit, TScore& score) {
    const auto result = bench::mrptJcbb(scene.problem, limit);
    if (!result) {
        ++score.stopped;
        return;
    }
    score.add(result->landmarks, scene.truth);
    score.milliseconds.push_back(1000 * result->seconds);
    score.nodes.push_back(static_cast<double>(result->nodes));
}

void print(const bench::TSceneSize& size,
           double sigma,
           const std::string& method,
           const TScore& score) {
    const auto percent = [&](std::size_t count) {
        char text[16] = "-";
        if (score.seen > 0)
            std::snprintf(text, sizeof text, "%.1f",
                          100 * static_cast<double>(count) / static_cast<double>(score.seen));
        return std::string(text);
    };
    const std::size_t runs = score.seen / size.observations;
    std::printf("| %zux%zu | %.1f | %s | %zu | %.2f | %.2f | %.0f | %.0f | %s | %s | %zu |\n",
                size.observations, size.landmarks, sigma, method.c_str(), runs,
                quantile(score.milliseconds, 0.5), quantile(score.milliseconds, 1),
                quantile(score.nodes, 0.5), quantile(score.nodes, 1), percent(score.right).c_str(),
                percent(score.wrong).c_str(), score.stopped);
    std::fflush(stdout);
}

void compare(const bench::TSceneSize& size, double sigma, const TArguments& arguments) {
    using association::EMethod;
    for (const auto& [name, method] :
         {std::pair("nn", EMethod::nn), std::pair("scnn", EMethod::scnn),
          std::pair("jcbb", EMethod::jcbb), std::pair("saliency", EMethod::saliency)}) {
        TScore score;
        for (std::uint32_t seed = 1; seed <= arguments.seeds; ++seed)
            addOurs(bench::makeScene(size, sigma, seed), method, score);
        print(size, sigma, name, score);
    }
    TScore mrpt;
    for (std::uint32_t seed = 1; seed <= arguments.mrptSeeds; ++seed)
        addMrpt(bench::makeScene(size, sigma, seed), arguments.mrptLimit, mrpt);
    print(size, sigma, "MRPT's JCBB", mrpt);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("JCBB of salma and of MRPT on random problems");
    TArguments arguments;
    app.add_option("--seeds", arguments.seeds, "problems of a row, seeds 1, 2, ...");
    app.add_option("--mrpt-seeds", arguments.mrptSeeds, "of these, problems that MRPT gets too");
    app.add_option("--mrpt-limit-s", arguments.mrptLimit, "after which MRPT's is killed");
    CLI11_PARSE(app, argc, argv);
    std::printf(
        "| size | sigma [m] | method | runs | median ms | max ms | median nodes | max nodes | "
        "right %% | wrong %% | stopped |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const bench::TSceneSize& size : {bench::TSceneSize{20, 100}, bench::TSceneSize{30, 200}})
        for (const double sigma : {0.1, 0.3, 0.6}) compare(size, sigma, arguments);
}
