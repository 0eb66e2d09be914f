// SPDX-License-Identifier: BSD-3-Clause
#include "growthPlot.h"

#include <salma/viz/CGnuplot.h>

namespace salma::bench {
namespace {

struct TCurve {
    const char* method;
    double yMin;
    const char* name;
    const char* style;
};

constexpr TCurve kCurves[] = {{"auto", 0, "all peaks", "lc rgb '#1f5fa8' pt 7"},
                              {"auto", 2.3, "Y >= 2.3 nat", "lc rgb '#c0392b' pt 5"},
                              {"SIFT", 0, "cv::SIFT", "lc rgb '#555555' dt 2 pt 6"},
                              {"MSER", 0, "cv::MSER", "lc rgb '#999999' dt 3 pt 4"}};

/// Writes one data block for each curve that has rows, and the command that plots them.
template <class POINT>
void plotCurves(viz::CGnuplot& plot,
                const std::string& block,
                const std::vector<TSpeedRow>& rows,
                POINT point) {
    std::string command = "plot ";
    for (const TCurve& curve : kCurves) {
        const std::string name = block + std::to_string(&curve - kCurves);
        std::ostream& data = plot.data(name);
        bool some = false;
        for (const TSpeedRow& row : rows) {
            if (row.which.method != curve.method || row.which.yMin != curve.yMin) continue;
            const auto [x, y] = point(row);
            data << x << " " << y << "\n";
            some = true;
        }
        plot.endData();
        if (some)
            command += "$" + name + " using 1:2 with linespoints lw 2 " + curve.style + " title '" +
                       curve.name + "', ";
    }
    plot.script() << command.substr(0, command.rfind(',')) << "\n";
}

}  // namespace

void plotGrowth(const std::vector<TSpeedRow>& bySize,
                const std::vector<TSpeedRow>& byScale,
                const std::string& file) {
    viz::CGnuplot plot(1000, 400);
    plot.script() << "set multiplot layout 1,2\nset grid lc rgb '#dddddd'\nset key top left\n"
                     "set border 3\nset tics nomirror\n"
                     "set xlabel 'pixels of the picture [million]'\nset ylabel 'time [ms]'\n"
                     "set xrange [0:]\nset yrange [0:]\n";
    plotCurves(plot, "size", bySize, [](const TSpeedRow& row) {
        return std::make_pair(row.which.size.area() / 1e6, row.ms);
    });
    plot.script() << "set xlabel 'largest scale [px]'\nset ylabel 'cycles for each centre'\n";
    plotCurves(plot, "scale", byScale, [](const TSpeedRow& row) {
        return std::make_pair(double(row.which.scaleMax), row.cycles);
    });
    plot.script() << "unset multiplot\n";
    plot.run(file);
}

}  // namespace salma::bench
