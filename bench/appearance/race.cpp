// SPDX-License-Identifier: BSD-3-Clause
// Rectified patches against plain SIFT on the pictures as they are: figures of docs/recognition.md.
#include <salma/appearance/CPatchMatcher.h>
#include <salma/viz/CGnuplot.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <set>

#include "CDescriber.h"
#include "CPosterViews.h"
#include "pictureSets.h"

namespace {

using namespace salma;

constexpr std::size_t kOtherStep = 4;  // every fourth pair of views of different posters
constexpr int kBins = 5;
constexpr double kOpposite = mrpt::DEG2RAD(130.0);
constexpr double kMargin = 5;     // around the poster's outline, for plain SIFT [px]
constexpr float kRatio = 0.8F;    // of plain SIFT, as of ours
constexpr double kTolerance = 3;  // of its homography [px]

struct TArguments {
    std::string set{"held-out"};
    std::uint32_t views{30};
    std::uint32_t seed{2};
    std::string plot;
};

struct TSight {
    std::size_t poster{0};
    double incidence{0};
    std::optional<observations::TPatch> patch;
    std::vector<cv::KeyPoint> keypoints;
    cv::Mat descriptors;
};

/// What the pairs of one method scored.
struct TMethod {
    std::string name;
    std::array<std::vector<double>, kBins> same;
    std::vector<double> other;
    double seconds{0};

    /// Share of the same that scores above every other, in each bin and over all.
    std::array<double, kBins + 1> recall() const {
        const double highest = *std::max_element(other.begin(), other.end());
        std::array<double, kBins + 1> out{};
        double found = 0, all = 0;
        for (std::size_t bin = 0; bin < kBins; ++bin) {
            const auto n = static_cast<double>(std::count_if(
                same[bin].begin(), same[bin].end(), [&](double s) { return s > highest; }));
            out[bin] = n / static_cast<double>(same[bin].size());
            found += n;
            all += static_cast<double>(same[bin].size());
        }
        out[kBins] = found / all;
        return out;
    }
};

/// The part of a picture that shows the poster: what selection gives to plain SIFT.
cv::Rect outline(const bench::TPosterView& view) {
    cv::Point2d low(1e9, 1e9), high(-1e9, -1e9);
    for (const double u : {view.place.u0, view.place.u1})
        for (const double v : {view.place.v0, view.place.v1}) {
            const auto p = *view.truth.toPixel(u, v);
            low = {std::min(low.x, p.x), std::min(low.y, p.y)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        }
    const cv::Rect box(cv::Point(cvFloor(low.x - kMargin), cvFloor(low.y - kMargin)),
                       cv::Point(cvCeil(high.x + kMargin), cvCeil(high.y + kMargin)));
    return box & cv::Rect(0, 0, view.grey.cols, view.grey.rows);
}

/// Pairs that agree on a homography.
struct TPlainMatch {
    double all{0};       //!< Also many points of one picture on one point of the other.
    double distinct{0};  //!< Each point once; 0 if the homography turns the picture over.
};

/// Agreeing pairs whose points in the second picture are all different.
double distinctPairs(const std::vector<cv::Point2f>& to, const cv::Mat& inliers) {
    std::set<std::pair<float, float>> seen;
    for (std::size_t i = 0; i < to.size(); ++i)
        if (inliers.at<std::uint8_t>(static_cast<int>(i)) != 0) seen.insert({to[i].x, to[i].y});
    return static_cast<double>(seen.size());
}

TPlainMatch plainMatch(const TSight& a, const TSight& b) {
    if (std::min(a.descriptors.rows, b.descriptors.rows) < 2) return {};
    std::vector<std::vector<cv::DMatch>> nearest;
    cv::BFMatcher(cv::NORM_L2).knnMatch(a.descriptors, b.descriptors, nearest, 2);
    std::vector<cv::Point2f> from, to;
    for (const auto& n : nearest)
        if (n[0].distance < kRatio * n[1].distance) {
            from.push_back(a.keypoints[static_cast<std::size_t>(n[0].queryIdx)].pt);
            to.push_back(b.keypoints[static_cast<std::size_t>(n[0].trainIdx)].pt);
        }
    if (from.size() < 4) return {};
    cv::Mat inliers;
    const cv::Mat H = cv::findHomography(from, to, cv::RANSAC, kTolerance, inliers);
    if (H.empty()) return {};
    const bool upright = cv::determinant(H(cv::Rect(0, 0, 2, 2))) > 0;
    return {static_cast<double>(cv::countNonZero(inliers)),
            upright ? distinctPairs(to, inliers) : 0};
}

double timed(double& seconds, const std::function<void()>& step) {
    const auto start = std::chrono::steady_clock::now();
    step();
    return seconds +=
           std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

class CRace {
 public:
    explicit CRace(const TArguments& arguments) : m_arguments(arguments) {
        m_methods[0].name = "rectified patches";
        m_methods[1].name = "rectified patches, keypoints only";
        m_methods[2].name = "plain SIFT";
        m_methods[3].name = "plain SIFT, each point once";
    }

    void run() {
        for (std::size_t i = 0; i < bench::pictureSet(m_arguments.set).size(); ++i) look(i);
        for (std::size_t i = 0; i < m_sights.size(); ++i)
            for (std::size_t j = i + 1; j < m_sights.size(); ++j)
                if (m_sights[i].poster == m_sights[j].poster || (i + j) % kOtherStep == 0)
                    compare(m_sights[i], m_sights[j]);
        report();
        if (!m_arguments.plot.empty()) draw();
    }

 private:
    void look(std::size_t poster) {
        const auto& name = bench::pictureSet(m_arguments.set)[poster];
        const bench::CPosterViews views(
            bench::pictureFile(SALMA_DATA_DIR, name), bench::kWalls[poster % bench::kWalls.size()],
            bench::kPosterHeight, 1000 * m_arguments.seed + static_cast<std::uint32_t>(poster));
        const auto sift = cv::SIFT::create();
        for (std::uint32_t i = 0; i < m_arguments.views; ++i) {
            const auto view = views.view(i);
            TSight sight;
            sight.poster = poster;
            sight.incidence = view.incidence;
            timed(m_ours, [&] { sight.patch = m_describer.patchOf(view); });
            timed(m_theirs, [&] {
                sift->detectAndCompute(view.grey(outline(view)), cv::noArray(), sight.keypoints,
                                       sight.descriptors);
            });
            m_refused += sight.patch ? 0 : 1;
            m_sights.push_back(std::move(sight));
        }
    }

    void compare(const TSight& a, const TSight& b) {
        const bool same = a.poster == b.poster;
        appearance::TPatchMatch ours;
        timed(m_methods[0].seconds, [&] {
            if (a.patch && b.patch) ours = m_matcher.match(*a.patch, *b.patch);
        });
        TPlainMatch theirs;
        timed(m_methods[2].seconds, [&] { theirs = plainMatch(a, b); });
        const double scores[] = {ours.score, ours.keypointScore, theirs.all, theirs.distinct};
        const auto bin = static_cast<std::size_t>(
            std::min(kBins - 1.0, std::abs(a.incidence - b.incidence) / kOpposite * kBins));
        for (std::size_t m = 0; m < m_methods.size(); ++m)
            (same ? m_methods[m].same[bin] : m_methods[m].other).push_back(scores[m]);
    }

    void report() const {
        std::printf("set %s, %u views each, seed %u, refused %zu of %zu; pairs of others %zu\n",
                    m_arguments.set.c_str(), m_arguments.views, m_arguments.seed, m_refused,
                    m_sights.size(), m_methods[0].other.size());
        std::printf("recall at 100 %% precision by difference of viewing angle\npairs");
        for (const auto& bin : m_methods[0].same) std::printf(" %zu", bin.size());
        for (const auto& method : m_methods) {
            std::printf("\n%-34s", method.name.c_str());
            for (const double r : method.recall()) std::printf(" %6.1f", 100 * r);
        }
        const auto views = static_cast<double>(m_sights.size());
        std::size_t pairs = m_methods[0].other.size();
        for (const auto& bin : m_methods[0].same) pairs += bin.size();
        std::printf(
            "\ntime: rectify and describe %.2f ms, plain SIFT %.2f ms a view; match %.2f ms, plain "
            "%.2f ms a pair\n",
            1e3 * m_ours / views, 1e3 * m_theirs / views,
            1e3 * m_methods[0].seconds / static_cast<double>(pairs),
            1e3 * m_methods[2].seconds / static_cast<double>(pairs));
    }

    void draw() const {
        viz::CGnuplot plot(760, 440);
        constexpr std::array<const char*, 4> kColours = {"#1f5fd0", "#7fa8e8", "#d62728",
                                                         "#f0a0a0"};
        std::string elements;
        for (std::size_t m = 0; m < m_methods.size(); ++m) {
            const std::string block = "method" + std::to_string(m);
            auto& data = plot.data(block);
            const auto recall = m_methods[m].recall();
            for (std::size_t bin = 0; bin < kBins; ++bin)
                data << 26 * (static_cast<double>(bin) + 0.5) << " " << 100 * recall[bin] << "\n";
            plot.endData();
            elements += (m == 0 ? "$" : ", $") + block + " with linespoints lw 2 ps 1.3 pt " +
                        std::to_string(5 + 2 * (m / 2)) + " dt " + std::to_string(1 + m % 2) +
                        " lc rgb '" + kColours[m] + "' title '" + m_methods[m].name + "'";
        }
        plot.script() << "set xrange [0:130]\nset xtics 26\nset yrange [0:103]\n"
                      << "set xlabel 'difference of viewing angle [deg]'\n"
                      << "set ylabel 'recall at 100 % precision [%]' offset 1,0\n"
                      << "set grid lc rgb '#e0e0e0' lt 1 lw 1\n"
                      << "set key tmargin center horizontal samplen 3 maxcols 2\nplot " << elements
                      << "\n";
        plot.run(m_arguments.plot);
    }

    TArguments m_arguments;
    bench::CDescriber m_describer;
    appearance::CPatchMatcher m_matcher;
    std::vector<TSight> m_sights;
    std::array<TMethod, 4> m_methods;
    std::size_t m_refused{0};
    double m_ours{0}, m_theirs{0};  // to describe all views [s]
};

}  // namespace

int main(int argc, char** argv) {
    TArguments arguments;
    CLI::App app("rectified patches against plain SIFT, recall at 100 % precision");
    app.add_option("--set", arguments.set, "of pictures")
        ->check(CLI::IsMember(bench::pictureSetNames()))
        ->capture_default_str();
    app.add_option("--views", arguments.views, "of each poster")->capture_default_str();
    app.add_option("--seed", arguments.seed, "of the views")->capture_default_str();
    app.add_option("--plot", arguments.plot, "PNG to draw");
    CLI11_PARSE(app, argc, argv);
    try {
        CRace(arguments).run();
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "sift-race: %s\n", e.what());
        return 1;
    }
}
