// SPDX-License-Identifier: BSD-3-Clause
// Real pictures of three planes, rectified by true and by estimated maps: docs/recognition.md.
#include <salma/appearance/CPatchMatcher.h>
#include <salma/appearance/CPictureMatcher.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <opencv2/imgcodecs.hpp>
#include <random>

#include "CPlanePictures.h"

namespace {

using namespace salma;
using bench::Corners;

constexpr double kCornerSigma = 1.5;  // of a corner that a border finder gives [px]
constexpr int kDraws = 20;

struct TOther {
    std::string name;
    cv::Mat picture;
    std::optional<observations::TPatch> patch;
};

double aspectOf(const Corners& rectangle) {
    return (rectangle[1].x - rectangle[0].x) / (rectangle[3].y - rectangle[0].y);
}

Corners disturbed(Corners corners, std::mt19937& random) {
    std::normal_distribution<double> n(0, kCornerSigma);
    for (auto& c : corners) {
        c.x += n(random);
        c.y += n(random);
    }
    return corners;
}

class CRealPictures {
 public:
    explicit CRealPictures(const std::string& data) : m_data(data) {}

    void run() {
        for (const char* name : {"graf", "boat", "churchill"})
            m_sets.emplace(name, bench::CPlanePictures::ofSet(m_data, name));
        std::printf(
            "view of picture 1: slant; true map: score, log ratio; four corners with %.1f px "
            "of noise: log ratio > 0 and >= 2.3 of %d, least log ratio; map found by SIFT: score, "
            "log "
            "ratio; pictures as they are (salma-features match): score, decision\n",
            kCornerSigma, kDraws);
        for (const auto& [name, set] : m_sets)
            for (std::size_t k = 1; k < set.size(); ++k) pairOf(name, set, k);
        corridor();
        others();
    }

 private:
    void pairOf(const std::string& name, const bench::CPlanePictures& set, std::size_t k) {
        const auto rectangle = set.common(k);
        const double aspect = aspectOf(rectangle);
        const auto a = bench::patchOf(set.picture(0), rectangle, aspect);
        const auto b = bench::patchOf(set.picture(k), set.inPicture(rectangle, k), aspect);
        std::printf("%-10s 1-%zu %3.0f deg", name.c_str(), k + 1, mrpt::RAD2DEG(set.angle(k)));
        print(a, b);
        std::mt19937 random(static_cast<std::uint32_t>(k));
        int positive = 0, sure = 0;
        double least = 10;
        for (int i = 0; i < kDraws; ++i) {
            const auto c = bench::patchOf(set.picture(0), disturbed(rectangle, random), aspect);
            const auto d = bench::patchOf(set.picture(k),
                                          disturbed(set.inPicture(rectangle, k), random), aspect);
            const double ratio = c && d ? m_matcher.match(*c, *d).logLikelihoodRatio : -10;
            positive += ratio > 0 ? 1 : 0;
            sure += ratio >= 2.3 ? 1 : 0;
            least = std::min(least, ratio);
        }
        std::printf("; %d %d %.1f", positive, sure, least);
        const auto found = m_pictureMatcher.match(set.picture(0), set.picture(k));
        if (found.pairs.empty())
            std::printf("; none");
        else
            print(a, bench::patchOf(set.picture(k), bench::mapped(found.homography, rectangle),
                                    aspect));
        std::printf("; %.2f %s\n", found.score, asString(found.decision));
        m_patches[name].push_back(*a);
        m_patches[name].push_back(*b);
    }

    void print(const std::optional<observations::TPatch>& a,
               const std::optional<observations::TPatch>& b) const {
        if (!a || !b) {
            std::printf("; refused");
            return;
        }
        const auto match = m_matcher.match(*a, *b);
        std::printf("; %.2f (keypoints %.2f, regions %.2f) %.1f", match.score, match.keypointScore,
                    match.regionScore, match.logLikelihoodRatio);
    }

    /// Posters that two frames of the corridor show; corners by hand, to 2 px or so.
    void corridor() {
        struct TSight {
            const char* name;
            int frameA;
            Corners a;
            int frameB;
            Corners b;
            double aspect;
        };
        const TSight sights[] = {
            {"light blue, right",
             34,
             {{323.5, 152}, {349, 120}, {357.5, 266}, {330, 266}},
             35,
             {{338, 104}, {397.5, 29}, {417, 262}, {349, 266}},
             0.7},
        };
        for (const auto& s : sights) {
            const auto read = [&](int frame) {
                return cv::imread(m_data + "/corridor_images/" + std::to_string(frame) + ".jpg",
                                  cv::IMREAD_GRAYSCALE);
            };
            std::printf("corridor %d-%d, %s", s.frameA, s.frameB, s.name);
            print(bench::patchOf(read(s.frameA), s.a, s.aspect),
                  bench::patchOf(read(s.frameB), s.b, s.aspect));
            std::printf("\n");
        }
    }

    /// Is anything else taken for one of the three planes?
    void others() {
        std::vector<std::string> files;
        for (int k = 1; k <= 42; ++k)
            files.push_back(m_data + "/corridor_images/" + std::to_string(k) + ".jpg");
        for (const char* name : {"kodak01", "kodak03", "kodak05", "kodak07", "kodak09", "kodak11"})
            files.push_back(m_data + "/posters/" + name + ".png");
        const std::string photographs = "/usr/share/doc/opencv-doc/examples/data/";
        for (const char* name : {"fruits", "home", "butterfly", "baboon", "building", "messi5",
                                 "squirrel_cls", "board", "stuff", "starry_night"})
            files.push_back(photographs + name + ".jpg");
        std::vector<TOther> pictures;
        for (const auto& file : files) {
            const cv::Mat grey = cv::imread(file, cv::IMREAD_GRAYSCALE);
            if (grey.empty()) {
                std::printf("%s: cannot be read, left out\n", file.c_str());
                continue;
            }
            // taken to be of the plane's aspect, so that regions are compared too
            pictures.push_back({file, grey, std::nullopt});
        }
        for (const auto& [name, set] : m_sets) {
            const double aspect = aspectOf(set.common(1));
            Tally patches, plain;
            for (const auto& [otherName, otherSet] : m_sets)
                if (otherName != name)
                    for (std::size_t k = 0; k < otherSet.size(); ++k) {
                        compare(name,
                                bench::patchOf(otherSet.picture(k),
                                               bench::whole(otherSet.picture(k)), aspect),
                                patches);
                        comparePictures(set, otherSet.picture(k), plain);
                    }
            for (const auto& p : pictures) {
                compare(name, bench::patchOf(p.picture, bench::whole(p.picture), aspect), patches);
                comparePictures(set, p.picture, plain);
            }
            std::printf(
                "other pictures against %s: patches %d pairs, log ratio > 0 in %d, highest %.2f; "
                "pictures as they are: %d pairs, %d same, %d unknown\n",
                name.c_str(), patches.pairs, patches.taken, patches.highest, plain.pairs,
                plain.taken, plain.unknown);
        }
    }

    struct Tally {
        int pairs{0}, taken{0}, unknown{0};
        double highest{-10};
    };

    void compare(const std::string& set,
                 const std::optional<observations::TPatch>& other,
                 Tally& tally) const {
        if (!other) return;
        for (const auto& patch : m_patches.at(set)) {
            const double ratio = m_matcher.match(patch, *other).logLikelihoodRatio;
            ++tally.pairs;
            tally.taken += ratio > 0 ? 1 : 0;
            tally.highest = std::max(tally.highest, ratio);
        }
    }

    void comparePictures(const bench::CPlanePictures& set,
                         const cv::Mat& other,
                         Tally& tally) const {
        const auto decision = m_pictureMatcher.match(set.picture(0), other).decision;
        ++tally.pairs;
        tally.taken += decision == appearance::EDecision::same ? 1 : 0;
        tally.unknown += decision == appearance::EDecision::unknown ? 1 : 0;
    }

    std::string m_data;
    std::map<std::string, bench::CPlanePictures> m_sets;
    std::map<std::string, std::vector<observations::TPatch>> m_patches;
    appearance::CPatchMatcher m_matcher;
    appearance::CPictureMatcher m_pictureMatcher;
};

}  // namespace

int main(int argc, char** argv) {
    std::string data = SALMA_DATA_DIR;
    CLI::App app("recognition of real pictures of planes");
    app.add_option("--data", data, "folder with homography, corridor_images and posters")
        ->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    try {
        CRealPictures(data).run();
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "real-pictures: %s\n", e.what());
        return 1;
    }
}
