// SPDX-License-Identifier: BSD-3-Clause
#include "TDemo.h"

#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>

namespace salma::bench {
namespace {

using mrpt::math::TPoint3D;

/// The first three numbers of each row; lines that begin with % are comments.
std::vector<TPoint3D> readPoints(const std::string& file) {
    std::ifstream in(file);
    if (!in) throw std::runtime_error(file + ": cannot be read");
    std::vector<TPoint3D> points;
    for (std::string line; std::getline(in, line);) {
        if (line.empty() || line[0] == '%') continue;
        std::istringstream words(line);
        TPoint3D point;
        if (!(words >> point.x >> point.y >> point.z))
            throw std::runtime_error(file + ": '" + line + "' does not begin with three numbers");
        points.push_back(point);
    }
    if (points.empty()) throw std::runtime_error(file + ": holds no point");
    return points;
}

double rms(double sum, std::size_t count) {
    return count == 0 ? 0 : std::sqrt(sum / static_cast<double>(count));
}

}  // namespace

TDemo TDemo::read(const std::string& stem) {
    TDemo demo;
    demo.rawlog = stem + ".rawlog";
    demo.path = readPoints(stem + "_ground_truth_robot_path.txt");
    demo.landmarks = readPoints(stem + "_ground_truth.txt");
    return demo;
}

TDemoScore score(const TDemo& demo, const TDemoRun& run) {
    // MRPT's programs pass over the first frame, since no action stands before it.
    const std::size_t passedOver = demo.path.size() - run.path.size();
    if (run.path.size() > demo.path.size() || passedOver > 1)
        throw std::invalid_argument(demo.rawlog + ": " + std::to_string(run.path.size()) +
                                    " steps, but " + std::to_string(demo.path.size()) +
                                    " true poses");
    TDemoScore result;
    double sum = 0;
    for (std::size_t i = 0; i < run.path.size(); ++i) {
        const double apart = (run.path[i] - demo.path[i + passedOver]).norm();
        sum += apart * apart;
    }
    result.pathRms = rms(sum, run.path.size());
    std::set<std::size_t> claimed;
    sum = 0;
    for (const TPoint3D& landmark : run.landmarks) {
        std::size_t nearest = 0;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < demo.landmarks.size(); ++k) {
            const double apart = (landmark - demo.landmarks[k]).norm();
            if (apart >= least) continue;
            least = apart;
            nearest = k;
        }
        sum += least * least;
        result.duplicates += !claimed.insert(nearest).second;
    }
    result.landmarks = run.landmarks.size();
    result.landmarkRms = rms(sum, run.landmarks.size());
    result.millisecondsPerStep = 1000 * run.seconds / static_cast<double>(run.path.size());
    return result;
}

}  // namespace salma::bench
