// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/saliency/CAffineSaliency.h>
#include <salma/saliency/CClusterer.h>
#include <salma/saliency/CExternalDetector.h>
#include <salma/saliency/CQuadrilaterals.h>
#include <salma/saliency/CScaleSaliency.h>
#include <salma/saliency/CStableRegions.h>

#include <CLI/CLI.hpp>
#include <ostream>
#include <string>
#include <vector>

namespace salma::apps {

/// What `detect` takes from a configuration file.
struct TDetectConfig {
    saliency::TScaleSaliencyOptions saliency;
    saliency::TClusteringOptions clustering;
    saliency::TAffineOptions affine;
    saliency::TStableRegionsOptions mser;
    saliency::TQuadOptions quad;
    saliency::TExternalOptions external;

    /// Other sections of the file are left unread. \throw std::invalid_argument
    static TDetectConfig load(const std::string& file);
    /// These sections with every key.
    std::string asIni() const;
};

/** `salma-features detect IMAGE... --out DIR`: salient regions as tables, region files and
 * overlays. Adds its subcommand to an app and keeps what that was given. */
class CDetectCommand {
 public:
    /// `app` may parse only while this object lives.
    explicit CDetectCommand(CLI::App& app);
    CDetectCommand(const CDetectCommand&) = delete;
    CDetectCommand& operator=(const CDetectCommand&) = delete;

    bool isChosen() const { return m_command->parsed(); }

    /** Writes all files, or none if it fails; one line to `out` for each picture.
     * \throw std::invalid_argument, std::runtime_error naming the file at fault. */
    void run(std::ostream& out);

 private:
    /// What CLI11 does not check itself. \throw CLI::ParseError
    void checkUsage() const;
    /// Each writes the files that begin with `prefix`, and says in words what was found.
    std::string find(const cv::Mat& grey, const std::string& prefix) const;
    std::string findSalient(const cv::Mat& grey, const std::string& prefix) const;
    std::string findStable(const cv::Mat& grey, const std::string& prefix) const;
    std::string findExternal(const cv::Mat& grey, const std::string& prefix) const;
    std::string findQuads(const cv::Mat& grey, const std::string& prefix) const;

    CLI::App* m_command;
    TDetectConfig m_config;
    std::vector<std::string> m_images;
    std::string m_out;
    std::string m_configFile;
    std::string m_detector{"scale-saliency"};
    double m_yMin{0};
    bool m_affine{false};
    bool m_peaks{false};
    bool m_printConfig{false};
};

}  // namespace salma::apps
