// SPDX-License-Identifier: BSD-3-Clause
#include <salma/saliency/CExternalDetector.h>
#include <salma/saliency/regionFiles.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "runCommand.h"

namespace fs = std::filesystem;

namespace salma::saliency {
namespace {

/// A fresh folder that goes with all it holds.
class CScratchFolder {
 public:
    CScratchFolder() {
        std::string name = (fs::temp_directory_path() / "salma-regions-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr)
            throw std::runtime_error(name + ": no folder can be made there");
        m_path = name;
    }
    ~CScratchFolder() {
        std::error_code ignored;
        fs::remove_all(m_path, ignored);
    }
    CScratchFolder(const CScratchFolder&) = delete;
    CScratchFolder& operator=(const CScratchFolder&) = delete;
    std::string operator/(const std::string& name) const { return (m_path / name).string(); }

 private:
    fs::path m_path;
};

/// Words at blanks; "two words" in quotes are one. \throw std::invalid_argument
std::vector<std::string> split(const std::string& command) {
    std::vector<std::string> words;
    bool quoted = false, inWord = false;
    for (const char c : command) {
        if (c == '"') quoted = !quoted;
        if (c == ' ' && !quoted) {
            inWord = false;
            continue;
        }
        if (!inWord) words.emplace_back();
        inWord = true;
        if (c != '"') words.back() += c;
    }
    if (quoted) throw std::invalid_argument("command lacks a closing quote");
    return words;
}

void replace(std::string& word, const std::string& name, const std::string& value) {
    for (std::size_t at = 0; (at = word.find(name, at)) != std::string::npos; at += value.size())
        word.replace(at, name.size(), value);
}

void writePgm(const std::string& file, const cv::Mat& grey) {
    std::ofstream out(file, std::ios::binary);
    out << "P5\n" << grey.cols << " " << grey.rows << "\n255\n";
    for (int row = 0; row < grey.rows; ++row)
        out.write(reinterpret_cast<const char*>(grey.ptr(row)), grey.cols);
    out.close();
    if (!out) throw std::runtime_error(file + ": cannot be written");
}

}  // namespace

void TExternalOptions::visit(config::COptionVisitor& v) {
    v.text("command", command,
           "of detector = external, e.g. h_affine.ln -haraff -i {image} -o {regions}");
    v.number("time_limit_s", timeLimit, config::moreThan(0), "longest run for a picture");
    v.integer("max_regions", maxRegions, config::between(1, 100000),
              "more regions of a picture are an error");
}

void TExternalOptions::validate() const {
    checkRanges();
    if (command.empty()) return;
    split(command);
    for (const char* name : {"{image}", "{regions}"})
        if (command.find(name) == std::string::npos)
            throw std::invalid_argument("command = '" + command + "' lacks " + name);
}

CExternalDetector::CExternalDetector(const TExternalOptions& options) : m_options(options) {
    m_options.validate();
}

std::vector<std::string> CExternalDetector::words(const std::string& image,
                                                  const std::string& regions) const {
    auto all = split(m_options.command);
    for (auto& word : all) {
        replace(word, "{image}", image);
        replace(word, "{regions}", regions);
    }
    return all;
}

std::vector<TEllipse> CExternalDetector::detect(const cv::Mat& grey) const {
    if (grey.type() != CV_8UC1)
        throw std::invalid_argument("external detector: the picture is not 8-bit grey");
    if (m_options.command.empty())
        throw std::runtime_error("detector = external needs a command in [external]");
    const CScratchFolder folder;
    const std::string image = folder / "picture.pgm", file = folder / "regions.txt";
    writePgm(image, grey);
    const auto command = words(image, file);
    const auto fail = [&](const std::string& problem) {
        throw std::runtime_error("external detector '" + command[0] + "' " + problem);
    };
    std::vector<TEllipse> regions;
    try {
        TCommandLimits limits;
        limits.seconds = m_options.timeLimit;
        const std::string problem = runCommand(command, limits);
        if (!problem.empty()) fail(problem);
        if (!fs::is_regular_file(file)) fail("wrote no region file");
        for (const auto& region : readVgg(file, static_cast<std::size_t>(m_options.maxRegions)))
            if (region.u >= 0 && region.u <= grey.cols - 1 && region.v >= 0 &&
                region.v <= grey.rows - 1)
                regions.push_back(region);
    } catch (const std::runtime_error& error) {
        const std::string text = error.what();
        if (text.find("external detector") == 0) throw;
        fail(text.find(file) == 0 ? "wrote no good region file, line" + text.substr(file.size())
                                  : text);
    }
    return regions;
}

}  // namespace salma::saliency
