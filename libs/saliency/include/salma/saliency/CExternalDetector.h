// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>
#include <salma/saliency/TEllipse.h>

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace salma::saliency {

/// Section [external] of config.ini.
struct TExternalOptions : public config::TStrictOptions<TExternalOptions> {
    /// Program and arguments, in which {image} and {regions} stand for files; words in double
    /// quotes may hold blanks. No shell is involved.
    std::string command;
    double timeLimit{30};  //!< Longest run for a picture [s].
    int maxRegions{5000};  //!< More of a picture are an error.

    void visit(config::COptionVisitor& v);
    /// \throw std::invalid_argument also if a command lacks {image} or {regions}.
    void validate() const;
};

/** Another program as a detector of regions, such as the binaries of the affine-covariant benchmark
 * (http://www.robots.ox.ac.uk/~vgg/research/affine): it is given a picture as binary PGM and writes
 * a region file that readVgg() reads.
 *
 * The program runs in a process group of its own, without input, and all of the group is ended
 * after its time. It may crash, hang, or write what it likes, at most 32 MB: what is no region file
 * is an error, never a wrong result. Const is safe from several threads; each call starts the
 * program. */
class CExternalDetector {
 public:
    /// \throw std::invalid_argument if options are out of range.
    explicit CExternalDetector(const TExternalOptions& options);

    /** Regions whose centre lies in the picture, in the order of the file.
     * \param grey CV_8UC1.
     * \throw std::runtime_error naming the program, what became of it and what it said; also where
     * the options name none. */
    std::vector<TEllipse> detect(const cv::Mat& grey) const;

 private:
    std::vector<std::string> words(const std::string& image, const std::string& regions) const;

    TExternalOptions m_options;
};

}  // namespace salma::saliency
