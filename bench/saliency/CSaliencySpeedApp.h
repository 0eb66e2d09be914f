// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "CTimes.h"
#include "TCase.h"
#include "TTestPicture.h"
#include "processorSpeed.h"
#include "speedTables.h"

namespace salma::bench {

/** Scale saliency by each instruction set, its plain loops, SIFT and MSER: runs of all are mixed in
 * random order, and the shortest of each counts. */
class CSaliencySpeedApp {
 public:
    explicit CSaliencySpeedApp(CLI::App& app);
    void run(std::ostream& out);

 private:
    void addSpeed(const std::vector<TTestPicture>& pictures);
    void addGrowth(const std::vector<TTestPicture>& pictures);
    void addLoop(const std::string& name, const TSpeedLoop& loop);
    void addCase(const TCase& c, const cv::Mat& grey, std::vector<TCase>& cases);
    void printProcessor(std::ostream& out) const;
    double perSecond(const std::string& loop) const;
    std::vector<TBoundRow> bounds(const std::vector<TTestPicture>& pictures,
                                  const std::vector<TSpeedRow>& rows) const;
    void writeGrowth(const std::string& folder) const;

    std::string m_data{"../shared/data"};
    std::vector<std::string> m_pictures;
    std::vector<std::string> m_sizes{"320x240", "640x480", "768x576", "1024x768"};
    std::string m_only;
    int m_repetitions{10};
    std::string m_out;
    std::vector<TCase> m_speed;
    std::vector<TCase> m_bySize;
    std::vector<TCase> m_byScale;
    std::map<std::string, double> m_operations;  // of loops
    CTimes m_times;
};

}  // namespace salma::bench
