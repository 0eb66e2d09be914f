// SPDX-License-Identifier: BSD-3-Clause
#include "CSaliencySpeedApp.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "COutputFolder.h"
#include "growthPlot.h"

namespace salma::bench {
namespace {

constexpr double kThresholds[] = {0, 1.9, 2.3};  // all peaks, the default of y_min, Ho's preset
constexpr int kSlowRepetitions = 2;

cv::Size sizeNamed(const std::string& name) {
    std::istringstream in(name);
    cv::Size size;
    char x = 0;
    if (!(in >> size.width >> x >> size.height) || x != 'x' || !in.eof() ||
        std::min(size.width, size.height) < 100 || std::max(size.width, size.height) > 10000)
        throw CLI::ValidationError("--sizes",
                                   name + " is not a size such as 640x480 (100 to 10000 px)");
    return size;
}

/// Whose times are long, and only looked at roughly.
bool isSlow(const TCase& c) { return c.method == "plain" || c.method == "portable"; }

void writeText(const std::string& text, const std::string& file) {
    std::ofstream out(file);
    out << text;
    out.close();
    if (!out) throw std::runtime_error(file + ": cannot be written");
}

}  // namespace

CSaliencySpeedApp::CSaliencySpeedApp(CLI::App& app) {
    app.add_option("--data", m_data,
                   "folder with corridor_images/ and homography/graf/ (default ../shared/data)");
    app.add_option("--pictures", m_pictures,
                   "of corridor, stereo-calib, graf, synthetic (default: all that are there)");
    app.add_option("--sizes", m_sizes,
                   "sizes of the pictures (default 320x240 640x480 768x576 1024x768)");
    app.add_option("--only", m_only, "speed: the tables alone; growth: the plot alone")
        ->check(CLI::IsMember({"speed", "growth"}));
    app.add_option("--repetitions", m_repetitions, "of each run, plain loops fewer (default 10)")
        ->check(CLI::Range(1, 1000));
    app.add_option("--out", m_out, "folder for the results")->required();
}

void CSaliencySpeedApp::run(std::ostream& out) {
    const auto pictures = testPictures(m_data, m_pictures, out);
    if (pictures.empty()) throw std::runtime_error("there is no picture to be timed");
    apps::COutputFolder folder(m_out);
    addLoop("clock", dependentAdditions());
    for (const auto& set : instructionSets()) {
        const auto simd = simdNamed(set);
        if (vectorBits(simd) == 0) continue;
        addLoop("simple/" + set, simpleOperations(simd));
        addLoop("multiply-adds/" + set, multiplyAdds(simd));
        addLoop("loads/" + set, unalignedLoads(simd));
    }
    if (m_only != "growth") addSpeed(pictures);
    if (m_only != "speed") addGrowth(pictures);
    // So that a disturbance of seconds does not hit all repetitions of one case.
    std::array<std::string, 2> words{"saliency-speed",
                                     "--benchmark_enable_random_interleaving=true"};
    std::array<char*, 3> arguments{words[0].data(), words[1].data(), nullptr};
    int count = 2;
    benchmark::Initialize(&count, arguments.data());
    benchmark::RunSpecifiedBenchmarks(&m_times);

    std::ostringstream report;
    printProcessor(report);
    const auto rows = speedRows(m_speed, m_times, perSecond("clock"));
    printSpeed(rows, report);
    printBounds(bounds(pictures, rows), report);
    out << report.str();
    writeText(report.str(), folder / "speed.md");
    writeSpeedCsv(rows, folder / "speed.csv");
    if (!m_bySize.empty()) writeGrowth(folder.path());
    folder.publish();
    checkSameCounts(rows);
}

void CSaliencySpeedApp::addLoop(const std::string& name, const TSpeedLoop& loop) {
    m_operations[name] = loop.operations;
    benchmark::RegisterBenchmark(name.c_str(),
                                 [loop](benchmark::State& state) {
                                     for (auto _ : state) loop.run();
                                 })
        ->Iterations(1)
        ->Repetitions(5 * m_repetitions)
        ->UseRealTime();
}

void CSaliencySpeedApp::addCase(const TCase& c, const cv::Mat& grey, std::vector<TCase>& cases) {
    const auto known = [&](const std::vector<TCase>& list) {
        return std::any_of(list.begin(), list.end(),
                           [&](const TCase& d) { return d.name() == c.name(); });
    };
    const bool isNew = !known(m_speed) && !known(m_bySize) && !known(m_byScale);
    cases.push_back(c);
    if (!isNew) return;
    const auto run = [grey, detect = c.detector()](benchmark::State& state) {
        std::size_t regions = 0;
        for (auto _ : state) benchmark::DoNotOptimize(regions = detect(grey));
        state.counters["regions"] = static_cast<double>(regions);
    };
    benchmark::RegisterBenchmark(c.name().c_str(), run)
        ->Iterations(1)
        ->Repetitions(isSlow(c) ? std::min(m_repetitions, kSlowRepetitions) : m_repetitions)
        ->UseRealTime();
}

void CSaliencySpeedApp::addSpeed(const std::vector<TTestPicture>& pictures) {
    for (const auto& picture : pictures)
        for (const auto& sizeName : m_sizes) {
            const cv::Size size = sizeNamed(sizeName);
            const cv::Mat grey = picture.resized(size);
            for (const int threads : {1, 2})
                for (const char* method : {"SIFT", "MSER"})
                    addCase({picture.name, size, method, 0, threads}, grey, m_speed);
            addCase({picture.name, size, "plain"}, grey, m_speed);
            for (const auto& set : instructionSets())
                for (const double yMin : kThresholds)
                    for (int threads = 1; threads <= (set == "auto" ? 2 : 1); ++threads)
                        addCase({picture.name, size, set, yMin, threads}, grey, m_speed);
        }
}

void CSaliencySpeedApp::addGrowth(const std::vector<TTestPicture>& pictures) {
    const TTestPicture& picture = pictures.front();
    for (const int width : {160, 320, 480, 640, 800, 1024, 1280}) {
        const cv::Size size(width, width * 3 / 4);
        const cv::Mat grey = picture.resized(size);
        for (const char* method : {"SIFT", "MSER", "auto"})
            addCase({picture.name, size, method}, grey, m_bySize);
        addCase({picture.name, size, "auto", 2.3}, grey, m_bySize);
    }
    const cv::Size size(640, 480);
    const cv::Mat grey = picture.resized(size);
    for (const int scaleMax : {8, 12, 16, 20, 24, 28, 33, 36, 40, 41, 48, 64, 80, 100, 128})
        for (const double yMin : {0.0, 2.3})
            addCase({picture.name, size, "auto", yMin, 1, scaleMax}, grey, m_byScale);
}

/// Operations of a loop in a second.
double CSaliencySpeedApp::perSecond(const std::string& loop) const {
    return m_operations.at(loop) / m_times.find(loop)->seconds;
}

void CSaliencySpeedApp::printProcessor(std::ostream& out) const {
    std::ifstream info("/proc/cpuinfo");
    std::string line;
    while (std::getline(info, line) && line.rfind("model name", 0) != 0) {
    }
    const double clock = perSecond("clock");
    out << "Processor: " << (info ? line.substr(line.find(": ") + 2) : "unknown") << ", "
        << std::thread::hardware_concurrency() << " cores, " << clock / 1e9
        << " GHz by additions that wait for each other\n\n"
           "| set | vector | operations per cycle | multiply-adds | unaligned loads "
           "|\n|---|---|---|---|---|\n";
    for (const auto& set : instructionSets()) {
        const int bits = vectorBits(simdNamed(set));
        if (bits == 0) continue;
        out << "| " << set << " | " << bits << " bit";
        for (const char* loop : {"simple/", "multiply-adds/", "loads/"})
            out << " | " << perSecond(loop + set) / clock;
        out << " |\n";
    }
}

std::vector<TBoundRow> CSaliencySpeedApp::bounds(const std::vector<TTestPicture>& pictures,
                                                 const std::vector<TSpeedRow>& rows) const {
    std::vector<TBoundRow> found;
    const double clock = perSecond("clock");
    for (const TSpeedRow& row : rows) {
        const TCase& c = row.which;
        if (!c.isOurs() || c.method == "auto" || c.yMin > 0 || c.size != cv::Size(640, 480))
            continue;
        const auto simd = simdNamed(c.method);
        if (vectorBits(simd) == 0) continue;
        const auto picture = std::find_if(pictures.begin(), pictures.end(),
                                          [&](const auto& p) { return p.name == c.picture; });
        const auto perCycle = [&](const std::string& loop) {
            return perSecond(loop + "/" + c.method) / clock;
        };
        const TThroughput speed{simd, vectorBits(simd), perCycle("simple"),
                                perCycle("multiply-adds"), perCycle("loads")};
        const TWork work = found.empty() || found.back().picture != c.picture
                               ? workFor(picture->resized(c.size), c.options())
                               : found.back().work;
        found.push_back({c.picture, c.method, work, boundOf(work, c.options(), speed), row.cycles});
    }
    return found;
}

void CSaliencySpeedApp::writeGrowth(const std::string& folder) const {
    const double clock = perSecond("clock");
    const auto bySize = speedRows(m_bySize, m_times, clock);
    const auto byScale = speedRows(m_byScale, m_times, clock);
    writeSpeedCsv(bySize, folder + "/growth-pixels.csv");
    writeSpeedCsv(byScale, folder + "/growth-scales.csv");
    plotGrowth(bySize, byScale, folder + "/growth.png");
}

}  // namespace salma::bench
