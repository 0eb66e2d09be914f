// SPDX-License-Identifier: BSD-3-Clause
// How well the front end selects the same poster with the same extent: figures of
// docs/selection.md.
#include <mrpt/math/wrap2pi.h>
#include <salma/landmarks/CFrontEnd.h>
#include <salma/laser/CLineExtractor.h>
#include <salma/simulator/CLaserModel.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <string>
#include <vector>

#include "CDetectorScore.h"
#include "CPosterViews.h"
#include "scene.h"

namespace {

using namespace salma;
using bench::TSeenView;

struct TArguments {
    std::string set{"report"};
    std::uint32_t views{40};
    std::uint32_t seed{1};
    bool bare{false};
    std::vector<std::string> detectors{"scale-saliency", "mser", "both", "quad"};
    int tries{0};
    std::string failures;  //!< Folder for pictures of views that went wrong.
};

const std::map<std::string, landmarks::EDetector> kDetectors = {
    {"scale-saliency", landmarks::EDetector::scaleSaliency},
    {"mser", landmarks::EDetector::mser},
    {"both", landmarks::EDetector::both},
    {"quad", landmarks::EDetector::quad}};

/// A detector's front end and what it has seen.
struct TContestant {
    std::string name;
    landmarks::CFrontEnd frontEnd;
    std::vector<TSeenView> views;
    std::map<std::string, std::size_t> refused;
};

landmarks::CFrontEnd frontEndOf(const std::string& detector, int tries) {
    landmarks::TSeeingOptions options;
    options.selection.detector = kDetectors.at(detector);
    if (tries > 0) options.selection.maxTries = tries;
    return landmarks::CFrontEnd(options);
}

/// Lines of the scan that the robot makes where the view was taken; a laser of its own each time.
std::vector<laser::TLine> wallsOf(const simulator::CWorld& world,
                                  const mrpt::poses::CPose3D& robot,
                                  std::uint32_t seed) {
    const simulator::CLaserModel model(simulator::TLaserOptions(), world, seed);
    const auto scan = model.scan({robot.x(), robot.y(), robot.yaw()}, 0);
    return laser::CLineExtractor().extract(scan).lines;
}

bool isInside(const Eigen::Matrix<double, 2, 4>& corners, const Eigen::Vector2d& half) {
    const Eigen::Vector2d centre = corners.rowwise().mean();
    return std::abs(centre.x()) <= half.x() && std::abs(centre.y()) <= half.y();
}

class CSelectionBench {
 public:
    explicit CSelectionBench(const TArguments& arguments)
        : m_arguments(arguments), m_files(bench::filesOf(arguments.set)) {
        for (const auto& name : arguments.detectors)
            m_contestants.push_back({name, frontEndOf(name, arguments.tries), {}, {}});
    }

    void run() {
        for (std::size_t i = 0; i < m_files.size(); ++i) look(i);
        print();
    }

 private:
    void look(std::size_t poster) {
        const auto hanging = bench::hangingOf(m_files[poster], poster);
        const auto scene = bench::hallWith(hanging, !m_arguments.bare);
        const std::uint32_t seed = 1000 * m_arguments.seed + static_cast<std::uint32_t>(poster);
        const bench::CPosterViews views(scene, hanging.width, hanging.height, seed);
        const simulator::CWorld world(scene);
        for (std::uint32_t i = 0; i < m_arguments.views; ++i) {
            const auto view = views.view(i);
            landmarks::TView input;
            input.grey = view.grey;
            input.camera = view.truth.camera();
            input.T_r_c = view.seen.cameraPose();
            input.walls = wallsOf(world, view.robot, seed * 1000 + i);
            for (auto& contestant : m_contestants) {
                auto seen = judge(contestant, input, view, seed * 1000 + i);
                seen.poster = poster;
                contestant.views.push_back(seen);
            }
        }
    }

    TSeenView judge(TContestant& contestant,
                    const landmarks::TView& input,
                    const bench::TPosterView& view,
                    std::uint32_t seed) const {
        const auto start = std::chrono::steady_clock::now();
        const auto result = contestant.frontEnd.process(input);
        TSeenView seen;
        seen.seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        seen.distance = view.distance;
        seen.incidence = view.incidence;
        const auto& place = view.place;
        seen.half = {(place.u1 - place.u0) / 2, (place.v1 - place.v0) / 2};
        const Eigen::Vector2d middle((place.u0 + place.u1) / 2, (place.v0 + place.v1) / 2);
        for (const auto& patch : result.landmarks) {
            Eigen::Matrix<double, 2, 4> corners;
            for (int k = 0; k < 4; ++k) {
                const auto at = view.truth.toWall(patch.quad[static_cast<std::size_t>(k)]);
                corners.col(k).setConstant(1e3);
                if (at) corners.col(k) = Eigen::Vector2d(at->x, at->y) - middle;
            }
            if (m_arguments.bare || !isInside(corners, seen.half)) {
                ++seen.falseEntities;
            } else {
                seen.corners = corners;
                addPoseError(patch, view, middle, seed, seen);
            }
        }
        for (const auto& [reason, count] : result.refused) contestant.refused[reason] += count;
        saveIfWrong(contestant.name, seen, result, view, seed);
        return seen;
    }

    /** Height and lean of the poster are known by priors only ([rectification] height_sigma_m,
     * tilt_sigma_deg); the true ones are drawn from them. */
    static void addPoseError(const observations::TPatch& patch,
                             const bench::TPosterView& view,
                             const Eigen::Vector2d& middle,
                             std::uint32_t seed,
                             TSeenView& seen) {
        const appearance::TRectificationOptions priors;
        std::mt19937 random(seed);
        std::normal_distribution<double> n;
        const Eigen::Vector3d X = view.truth.point(middle.x(), middle.y());
        const auto& pose = patch.pose.mean;
        const double yaw = view.truth.wall().alpha - M_PI_2;
        seen.error << pose.x() - X.x(), pose.y() - X.y(),
            pose.z() - X.z() + priors.heightSigma * n(random),
            mrpt::math::wrapToPi(pose.yaw() - yaw), pose.pitch() + priors.tiltSigma * n(random),
            mrpt::math::wrapToPi(pose.roll() - M_PI_2) + priors.tiltSigma * n(random);
        seen.covariance = patch.pose.cov.asEigen();
    }

    void saveIfWrong(const std::string& detector,
                     const TSeenView& seen,
                     const landmarks::TFrontEndResult& result,
                     const bench::TPosterView& view,
                     std::uint32_t seed) const {
        if (m_arguments.failures.empty()) return;
        const auto& c = seen.corners;
        double worst = 9;
        if (c) {
            worst = 0;
            for (int k = 0; k < 4; ++k) {
                const double u = k == 1 || k == 2 ? seen.half.x() : -seen.half.x();
                const double v = k < 2 ? seen.half.y() : -seen.half.y();
                worst = std::max({worst, std::abs((*c)(0, k) - u), std::abs((*c)(1, k) - v)});
            }
        }
        if (worst <= 0.05 && seen.falseEntities == 0) return;
        cv::Mat picture;
        cv::cvtColor(view.grey, picture, cv::COLOR_GRAY2BGR);
        for (const auto& patch : result.landmarks) {
            std::vector<cv::Point> quad;
            for (const auto& p : patch.quad) quad.emplace_back(cv::Point2d(p.x, p.y));
            cv::polylines(picture, quad, true, {0, 0, 255}, 2, cv::LINE_AA);
        }
        std::string why;
        for (const auto& [reason, count] : result.refused)
            why += reason + " " + std::to_string(count) + "; ";
        cv::putText(picture, why, {5, 15}, cv::FONT_HERSHEY_SIMPLEX, 0.4, {0, 255, 255}, 1);
        cv::imwrite(m_arguments.failures + "/" + detector + "-" + std::to_string(seed) + ".png",
                    picture);
    }

    static void printShare(const char* what, const bench::TShare& s) {
        std::printf("  %-58s %5.1f %% (%5.1f to %5.1f), %zu of %zu\n", what, 100 * s.value(),
                    100 * s.low, 100 * s.high, s.hits, s.of);
    }

    static double halfWidth(double dof, std::size_t n) {
        return 1.96 * std::sqrt(2 * dof / static_cast<double>(n));
    }

    void print() const {
        std::printf("set %s, %zu pictures, %u views each, seed %u%s\n", m_arguments.set.c_str(),
                    m_files.size(), m_arguments.views, m_arguments.seed,
                    m_arguments.bare ? ", nothing hung" : "");
        for (const auto& c : m_contestants) {
            const auto f = bench::figuresOf(c.views, m_files.size());
            std::printf("%s: %.3f false entities and %.1f ms per picture\n", c.name.c_str(),
                        f.falsePerView, f.milliseconds);
            std::string reasons;
            for (const auto& [reason, count] : c.refused)
                reasons += (reasons.empty() ? "" : ", ") + std::to_string(count) + " " + reason;
            std::printf("  refused: %s\n", reasons.c_str());
            if (m_arguments.bare) continue;
            printShare("selected", f.selected);
            printShare("of these, all corners within 5 cm of the truth", f.nearTruth);
            printShare("of these, all corners within 5 cm of the median rectangle", f.nearMedian);
            printShare("selected with the true extent, of all views", f.wholly);
            std::printf("  median error of a corner's coordinate %.1f mm\n",
                        1e3 * f.medianSideError);
            std::printf(
                "  NEES (x, y, yaw) %.2f, interval 3 +- %.2f; all six %.2f, 6 +- %.2f; "
                "(x, y, yaw) where the extent is true %.2f, 3 +- %.2f\n",
                f.nees3, halfWidth(3, f.count), f.nees6, halfWidth(6, f.count), f.nees3Near,
                halfWidth(3, f.countNear));
            printByView(c);
        }
    }

    void printByView(const TContestant& c) const {
        const auto line = [&](const char* what, auto key, const std::vector<double>& limits) {
            std::printf("  %-10s", what);
            for (std::size_t b = 0; b + 1 < limits.size(); ++b) {
                std::vector<TSeenView> some;
                for (const auto& v : c.views)
                    if (key(v) >= limits[b] && key(v) < limits[b + 1]) some.push_back(v);
                const auto f = bench::figuresOf(some, m_files.size());
                std::printf(" | %g..%g: sel %.0f %%, ext %.0f %%, nees3 %.2f (%zu)", limits[b],
                            limits[b + 1], 100 * f.selected.value(), 100 * f.nearTruth.value(),
                            f.nees3, some.size());
            }
            std::printf("\n");
        };
        line("metres", [](const TSeenView& v) { return v.distance; }, {1, 2, 3, 4, 5, 6});
        line("degrees", [](const TSeenView& v) { return std::abs(v.incidence) * 180 / M_PI; },
             {0, 20, 40, 55, 66});
        std::printf("  by picture");
        for (std::size_t p = 0; p < m_files.size(); ++p) {
            std::vector<TSeenView> some;
            for (const auto& v : c.views)
                if (v.poster == p) some.push_back(v);
            const auto f = bench::figuresOf(some, m_files.size());
            std::printf(" | %s: %.0f %%, %.0f %%",
                        m_files[p].substr(m_files[p].rfind('/') + 1).c_str(),
                        100 * f.selected.value(), 100 * f.nearTruth.value());
        }
        std::printf("\n");
    }

    TArguments m_arguments;
    std::vector<std::string> m_files;
    std::vector<TContestant> m_contestants;
};

}  // namespace

int main(int argc, char** argv) {
    TArguments arguments;
    CLI::App app("Share of views in which a poster is selected with the same extent");
    app.add_option("--set", arguments.set, "pictures: tuning, report, photographs")
        ->check(CLI::IsMember({"tuning", "report", "photographs"}));
    app.add_option("--views", arguments.views, "of each picture")
        ->check(CLI::Range(std::uint32_t{1}, std::uint32_t{10000}));
    app.add_option("--seed", arguments.seed, "of views and noise");
    app.add_option("--detector", arguments.detectors, "those to compare; all of them")
        ->check(CLI::IsMember({"scale-saliency", "mser", "both", "quad"}));
    app.add_option("--tries", arguments.tries, "instead of max_tries of [selection]")
        ->check(CLI::Range(0, 100));
    app.add_flag("--bare", arguments.bare, "hang nothing: every entity is a false one");
    app.add_option("--failures", arguments.failures, "folder for pictures of views gone wrong")
        ->check(CLI::ExistingDirectory);
    CLI11_PARSE(app, argc, argv);
    try {
        CSelectionBench(arguments).run();
    } catch (const std::exception& e) {
        std::fprintf(stderr, "entity-selection: %s\n", e.what());
        return 1;
    }
    return 0;
}
