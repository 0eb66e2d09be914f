// SPDX-License-Identifier: BSD-3-Clause
#include "CDetectCommand.h"

#include <salma/config/CStrictFile.h>
#include <salma/saliency/regionFiles.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "COutputFolder.h"
#include "CProgressBar.h"
#include "overlay.h"
#include "readPicture.h"

namespace salma::apps {
namespace {

constexpr auto kDescription = "Finds salient regions in pictures; colour is turned to grey.";
constexpr auto kExamples =
    "Examples:\n"
    "  salma-features detect corridor.jpg --out out/features\n"
    "  salma-features detect a.png b.png --detector mser --config config.ini --out out/mser\n\n";

void writePicture(const std::string& file, const cv::Mat& picture) {
    if (!cv::imwrite(file, picture)) throw std::runtime_error(file + ": cannot be written");
}

}  // namespace

TDetectConfig TDetectConfig::load(const std::string& file) {
    const auto ini = config::openStrict(file);
    TDetectConfig loaded;
    loaded.saliency.loadFromConfigFile(*ini, "saliency");
    loaded.clustering.loadFromConfigFile(*ini, "clustering");
    loaded.affine.loadFromConfigFile(*ini, "affine");
    loaded.mser.loadFromConfigFile(*ini, "mser");
    loaded.quad.loadFromConfigFile(*ini, "quad");
    loaded.external.loadFromConfigFile(*ini, "external");
    return loaded;
}

std::string TDetectConfig::asIni() const {
    return saliency.asIni("saliency") + "\n" + clustering.asIni("clustering") + "\n" +
           affine.asIni("affine") + "\n" + mser.asIni("mser") + "\n" + quad.asIni("quad") + "\n" +
           external.asIni("external");
}

CDetectCommand::CDetectCommand(CLI::App& app)
    : m_command(app.add_subcommand("detect", kDescription)) {
    m_command->add_option("IMAGE", m_images, "pictures; their names must differ");
    m_command->add_option("--out", m_out, "folder for the results");
    m_command->add_option(
        "--config", m_configFile,
        "ini file: [saliency], [clustering], [affine], [mser], [quad], [external]");
    m_command
        ->add_option("--detector", m_detector,
                     "scale-saliency (default), mser, both of them, quad: closed contours "
                     "with four sides, or external: the program in [external]")
        ->check(CLI::IsMember({"scale-saliency", "mser", "both", "quad", "external"}));
    m_command->add_flag("--affine", m_affine,
                        "adapt the regions to ellipses, as [affine] use does");
    m_command->add_flag("--peaks", m_peaks, "write all entropy peaks too, before clustering");
    m_command->add_option("--y-min", m_yMin,
                          "least saliency of a region, in the detector's base (default 0)");
    m_command->add_flag("--print-config", m_printConfig, "print every key in use, and stop");
    // Examples belong to this command's own help, not to the list of commands.
    m_command->preparse_callback(
        [this](std::size_t) { m_command->description(std::string(kExamples) + kDescription); });
    m_command->callback([this] { checkUsage(); });
}

void CDetectCommand::checkUsage() const {
    if (m_printConfig) return;
    if (m_images.empty()) throw CLI::RequiredError("IMAGE");
    if (m_out.empty()) throw CLI::RequiredError("--out");
    if (!(m_yMin >= 0))  // false for NaN, which CLI11 lets pass
        throw CLI::ValidationError("--y-min", "must be a number from 0");
    const bool salient = m_detector == "scale-saliency" || m_detector == "both";
    if (!salient && (m_peaks || m_affine || m_command->count("--y-min") > 0))
        throw CLI::ValidationError("--detector " + m_detector,
                                   "has no entropy peaks, no saliency and no --affine");
}

void CDetectCommand::run(std::ostream& out) {
    if (!m_configFile.empty()) m_config = TDetectConfig::load(m_configFile);
    if (m_affine) m_config.affine.use = true;
    if (m_printConfig) {
        out << m_config.asIni();
        return;
    }
    rejectEqualStems(m_images);
    COutputFolder folder(m_out);
    {
        CProgressBar progress("detecting", m_images.size());
        for (const auto& image : m_images) {
            const cv::Mat grey = readGrey(image);
            const std::string stem = std::filesystem::path(image).stem().string();
            const std::string prefix = folder / stem;
            const std::string found = find(grey, prefix);
            out << stem << ": " << grey.cols << "x" << grey.rows << ", " << found << "\n";
            progress.step();
        }
    }
    folder.publishInto();
}

std::string CDetectCommand::find(const cv::Mat& grey, const std::string& prefix) const {
    if (m_detector == "quad") return findQuads(grey, prefix);
    if (m_detector == "external") return findExternal(grey, prefix);
    if (m_detector == "mser") return findStable(grey, prefix);
    if (m_detector == "scale-saliency") return findSalient(grey, prefix);
    return findSalient(grey, prefix) + ", " + findStable(grey, prefix + ".stable");
}

std::string CDetectCommand::findSalient(const cv::Mat& grey, const std::string& prefix) const {
    const int window = 2 * m_config.saliency.scaleMax + 1;
    const auto peaks = saliency::CScaleSaliency(m_config.saliency).detect(grey, {m_yMin});
    auto regions = saliency::createClusterer(m_config.clustering)->cluster(peaks).regions;
    std::vector<saliency::TEllipse> ellipses;
    std::string summary =
        std::to_string(peaks.size()) + " peaks, " + std::to_string(regions.size()) + " regions";
    if (m_config.affine.use) {
        auto adapted =
            saliency::CAffineSaliency(m_config.affine, m_config.saliency).adapt(grey, regions);
        summary += ", " + std::to_string(regions.size() - adapted.withoutPeak) +
                   " of them adapted to ellipses";
        std::stable_sort(adapted.regions.begin(), adapted.regions.end(),
                         [](const auto& a, const auto& b) { return a.Y > b.Y; });
        for (std::size_t i = 0; i < regions.size(); ++i) {
            regions[i] = saliency::asDisc(adapted.regions[i]);
            ellipses.push_back(adapted.regions[i].ellipse);
        }
    } else {
        std::transform(regions.begin(), regions.end(), std::back_inserter(ellipses),
                       saliency::ellipseOf);
    }
    if (m_peaks) saliency::writeRegionsCsv(prefix + ".peaks.csv", peaks);
    saliency::writeRegionsCsv(prefix + ".regions.csv", regions);
    saliency::writeVgg(prefix + ".vgg", ellipses);
    writePicture(prefix + ".overlay.png", drawOverlay(grey, ellipses));
    if (std::min(grey.rows, grey.cols) < window)
        summary += " (smaller than the window of " + std::to_string(window) + " px)";
    return summary;
}

std::string CDetectCommand::findStable(const cv::Mat& grey, const std::string& prefix) const {
    const auto regions = saliency::CStableRegions(m_config.mser).detect(grey);
    std::vector<saliency::TEllipse> ellipses;
    ellipses.reserve(regions.size());
    for (const auto& region : regions) ellipses.push_back(region.ellipse);
    saliency::writeRegionsCsv(prefix + ".regions.csv", regions);
    saliency::writeVgg(prefix + ".vgg", ellipses);
    writePicture(prefix + ".overlay.png", drawOverlay(grey, regions));
    return std::to_string(regions.size()) + " stable regions";
}

std::string CDetectCommand::findExternal(const cv::Mat& grey, const std::string& prefix) const {
    const auto ellipses = saliency::CExternalDetector(m_config.external).detect(grey);
    saliency::writeVgg(prefix + ".vgg", ellipses);
    writePicture(prefix + ".overlay.png", drawOverlay(grey, ellipses));
    return std::to_string(ellipses.size()) + " regions";
}

std::string CDetectCommand::findQuads(const cv::Mat& grey, const std::string& prefix) const {
    const auto quads = saliency::CQuadrilaterals(m_config.quad).detect(grey);
    saliency::writeQuadsCsv(prefix + ".quads.csv", quads);
    writePicture(prefix + ".overlay.png", drawOverlay(grey, quads));
    return std::to_string(quads.size()) + " quadrilaterals";
}

}  // namespace salma::apps
