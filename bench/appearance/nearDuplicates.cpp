// SPDX-License-Identifier: BSD-3-Clause
// Prints that are nearly the same, and views that are spoilt: figures of docs/recognition.md.
#include <salma/appearance/CPatchMatcher.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "CDescriber.h"
#include "CPosterViews.h"
#include "pictureSets.h"
#include "prints.h"

namespace {

using namespace salma;

constexpr double kHidden = 0.4;  // of a print
constexpr double kSure = 2.3;    // log ratio, ten to one

struct TArguments {
    std::string set{"held-out"};
    std::uint32_t views{14};
    std::uint32_t seed{3};
};

/// Views of one print.
struct TPrint {
    std::vector<bench::TPosterView> views;
    std::vector<std::optional<observations::TPatch>> patches;
};
using Prints = std::vector<TPrint>;
using Change = std::function<void(bench::TPosterView&)>;

/// A folder for textures of this run.
class CTextureFolder {
 public:
    CTextureFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "prints-XXXXXX").string();
        if (!mkdtemp(name.data())) throw std::runtime_error(name + ": cannot be made");
        m_folder = name;
    }
    ~CTextureFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(m_folder, ignored);
    }
    CTextureFolder(const CTextureFolder&) = delete;
    CTextureFolder& operator=(const CTextureFolder&) = delete;

    std::string write(const cv::Mat& print) {
        const auto file = (m_folder / (std::to_string(m_count++) + ".png")).string();
        if (!cv::imwrite(file, print)) throw std::runtime_error(file + ": cannot be written");
        return file;
    }

 private:
    std::filesystem::path m_folder;
    int m_count{0};
};

Change exposed(double gain) {
    return [gain](bench::TPosterView& view) { view.grey.convertTo(view.grey, -1, gain); };
}

Change blurred(double sigma) {
    return [sigma](bench::TPosterView& view) { cv::GaussianBlur(view.grey, view.grey, {}, sigma); };
}

class CNearDuplicates {
 public:
    explicit CNearDuplicates(const TArguments& arguments) : m_arguments(arguments) {}

    void run() {
        for (const auto& name : bench::pictureSet(m_arguments.set)) {
            const auto file = bench::pictureFile(SALMA_DATA_DIR, name);
            m_pictures.push_back(cv::imread(file));
            if (m_pictures.back().empty()) throw std::runtime_error(file + ": cannot be read");
        }
        std::printf("set %s, %u views of each print, seed %u\n%-44s %6s %8s %8s %8s %8s %8s\n",
                    m_arguments.set.c_str(), m_arguments.views, m_arguments.seed, "case", "pairs",
                    "refused", "LR>0 %", "LR>2.3 %", "mean LR", "score");
        const Prints prints = look(m_pictures, bench::kPosterHeight, 0);
        within("the same print", prints);
        others("another print", prints);
        duplicates(prints);
        spoilt(prints);
        signs();
    }

 private:
    void duplicates(const Prints& prints) {
        const auto changed = [&](const std::function<cv::Mat(const cv::Mat&)>& change,
                                 double height, int wall) {
            std::vector<cv::Mat> out;
            std::transform(m_pictures.begin(), m_pictures.end(), std::back_inserter(out), change);
            return look(out, height, wall);
        };
        const auto flipped = [&](int code) {
            return changed(
                [code](const cv::Mat& picture) {
                    cv::Mat out;
                    cv::flip(picture, out, code);
                    return out;
                },
                bench::kPosterHeight, 0);
        };
        constexpr double kHeight = bench::kPosterHeight;
        between("a second print on another wall", prints,
                changed([](const cv::Mat& p) { return p; }, kHeight, 1));
        between("its middle (60 %), of the same height", prints,
                changed([](const cv::Mat& p) { return bench::cropped(p, 0.6); }, kHeight, 0));
        between("its middle (60 %), not enlarged", prints,
                changed([](const cv::Mat& p) { return bench::cropped(p, 0.6); }, 0.6 * kHeight, 0));
        between("its middle (90 %), not enlarged", prints,
                changed([](const cv::Mat& p) { return bench::cropped(p, 0.9); }, 0.9 * kHeight, 0));
        between("mirrored", prints, flipped(1));
        between("upside down", prints, flipped(-1));
        const Prints series = changed(bench::ofSeries, 0.9, 0);
        within("a poster of a series, the same", series);
        others("a poster of a series, another one", series);
    }

    void spoilt(const Prints& prints) {
        const std::pair<const char*, Change> cases[] = {
            {"40 % hidden in one view", [](bench::TPosterView& v) { bench::hide(v, kHidden); }},
            {"one stop darker", exposed(0.5)},
            {"two stops darker", exposed(0.25)},
            {"one stop brighter", exposed(2)},
            {"two stops brighter", exposed(4)},
            {"blur of 1 px", blurred(1)},
            {"blur of 2 px", blurred(2)},
            {"blur of 4 px", blurred(4)}};
        for (const auto& [name, change] : cases) {
            Prints spoiltPrints = prints;
            for (auto& print : spoiltPrints)
                for (std::size_t i = 0; i < print.views.size(); ++i) {
                    print.views[i].grey = print.views[i].grey.clone();
                    change(print.views[i]);
                    print.patches[i] = m_describer.patchOf(print.views[i]);
                }
            acrossViews(name, prints, spoiltPrints, true);
            acrossViews(std::string(name) + ", another print", prints, spoiltPrints, false);
        }
    }

    void signs() {
        const Prints signs = look(bench::plainSigns(), 0.3, 0);
        within("plain signs, the same", signs);
        others("plain signs, another one", signs);
    }

    Prints look(const std::vector<cv::Mat>& pictures, double height, int wall) {
        Prints out;
        for (std::size_t i = 0; i < pictures.size(); ++i) {
            const auto file = m_folder.write(pictures[i]);
            const bench::CPosterViews views(
                file, bench::kWalls[(i + static_cast<std::size_t>(wall)) % bench::kWalls.size()],
                height, 10000 * m_arguments.seed + m_looks++);
            TPrint print;
            for (std::uint32_t k = 0; k < m_arguments.views; ++k) {
                print.views.push_back(views.view(k));
                print.patches.push_back(m_describer.patchOf(print.views.back()));
            }
            out.push_back(std::move(print));
        }
        return out;
    }

    struct TTally {
        int pairs{0}, refused{0}, positive{0}, sure{0};
        double ratio{0}, score{0};
    };

    void add(const std::optional<observations::TPatch>& a,
             const std::optional<observations::TPatch>& b,
             TTally& tally) const {
        ++tally.pairs;
        if (!a || !b) {
            ++tally.refused;
            return;
        }
        const auto match = m_matcher.match(*a, *b);
        tally.positive += match.logLikelihoodRatio > 0 ? 1 : 0;
        tally.sure += match.logLikelihoodRatio >= kSure ? 1 : 0;
        tally.ratio += match.logLikelihoodRatio;
        tally.score += match.score;
    }

    /// Refused pairs count as not recognised; means are over the others.
    static void print(const std::string& name, const TTally& t) {
        const double compared = std::max(1, t.pairs - t.refused);
        std::printf("%-44s %6d %8d %8.1f %8.1f %8.2f %8.2f\n", name.c_str(), t.pairs, t.refused,
                    100.0 * t.positive / t.pairs, 100.0 * t.sure / t.pairs, t.ratio / compared,
                    t.score / compared);
        std::fflush(stdout);
    }

    void within(const std::string& name, const Prints& prints) const {
        TTally tally;
        for (const auto& print : prints)
            for (std::size_t i = 0; i < print.patches.size(); ++i)
                for (std::size_t j = i + 1; j < print.patches.size(); ++j)
                    add(print.patches[i], print.patches[j], tally);
        print(name, tally);
    }

    /// Different views of prints of equal number in both, or of unequal numbers.
    void acrossViews(const std::string& name, const Prints& a, const Prints& b, bool same) const {
        TTally tally;
        for (std::size_t p = 0; p < a.size(); ++p)
            for (std::size_t q = 0; q < b.size(); ++q) {
                if ((p == q) != same) continue;
                for (std::size_t i = 0; i < a[p].patches.size(); ++i)
                    for (std::size_t j = 0; j < b[q].patches.size(); ++j)
                        if (i != j && (same || (i + j) % 7 == 0))
                            add(a[p].patches[i], b[q].patches[j], tally);
            }
        print(name, tally);
    }

    void between(const std::string& name, const Prints& a, const Prints& b) const {
        acrossViews(name, a, b, true);
    }

    void others(const std::string& name, const Prints& prints) const {
        acrossViews(name, prints, prints, false);
    }

    TArguments m_arguments;
    CTextureFolder m_folder;
    std::vector<cv::Mat> m_pictures;
    bench::CDescriber m_describer;
    appearance::CPatchMatcher m_matcher;
    std::uint32_t m_looks{0};
};

}  // namespace

int main(int argc, char** argv) {
    TArguments arguments;
    CLI::App app("recognition of prints that are nearly the same, and of spoilt views");
    app.add_option("--set", arguments.set, "of pictures")
        ->check(CLI::IsMember(bench::pictureSetNames()))
        ->capture_default_str();
    app.add_option("--views", arguments.views, "of each print")->capture_default_str();
    app.add_option("--seed", arguments.seed, "of the views")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    try {
        CNearDuplicates(arguments).run();
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "near-duplicates: %s\n", e.what());
        return 1;
    }
}
