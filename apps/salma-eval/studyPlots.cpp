// SPDX-License-Identifier: BSD-3-Clause
#include <salma/viz/CGnuplot.h>

#include <algorithm>
#include <cmath>

#include "studyFiles.h"

namespace salma::apps {
namespace {

using Names = std::vector<std::string>;
using Rows = std::vector<TStudyRow>;

/// A back end with a method, and how it is drawn: colours tell methods, strokes back ends.
struct TVariant {
    std::string backend, method, title, colour;
    std::size_t stroke{0};  //!< 0 for the first back end.
};

/// The different texts, in their order.
template <class TEXT>
Names different(const Rows& rows, const TEXT& textOf) {
    Names names;
    for (const auto& row : rows) {
        const std::string text = textOf(row);
        if (std::find(names.begin(), names.end(), text) == names.end()) names.push_back(text);
    }
    return names;
}

/// One colour for each method, whatever others are in the study.
std::string colourOf(const std::string& method) {
    if (method == "nn") return "#8a9096";
    if (method == "scnn") return "#e0a000";
    return method == "jcbb" ? "#d62728" : "#1f5fd0";
}

std::vector<TVariant> variantsOf(const Rows& rows) {
    const Names backends = different(rows, [](const auto& row) { return row.backend; });
    const Names methods = different(rows, [](const auto& row) { return row.method; });
    std::vector<TVariant> variants;
    for (std::size_t b = 0; b < backends.size(); ++b)
        for (const auto& method : methods)
            variants.push_back({backends[b], method,
                                backends.size() > 1 ? method + ", " + backends[b] : method,
                                colourOf(method), b});
    return variants;
}

Names worldsOf(const Rows& rows) {
    return different(rows, [](const auto& row) { return row.world; });
}

/// Levels of noise, without the rows that put them together.
Names levelsOf(const Rows& rows) {
    Names names = different(rows, [](const auto& row) { return row.noise; });
    if (names.size() > 1) names.erase(std::remove(names.begin(), names.end(), "all"), names.end());
    return names;
}

const TStudyRow* find(const Rows& rows,
                      const std::string& world,
                      const std::string& noise,
                      const TVariant& variant) {
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const auto& row) {
        return row.world == world && row.noise == noise && row.backend == variant.backend &&
               row.method == variant.method;
    });
    return found == rows.end() ? nullptr : &*found;
}

/// A picture of panels side by side with one legend below.
class CPanels {
 public:
    CPanels(const Names& titles, const std::string& xLabel, const std::string& yLabel)
        : m_titles(titles), m_plot(widthOf(titles.size()), 600) {
        const double width = widthOf(titles.size());
        m_plot.script() << "set grid ytics lc rgb '#e6e6e6' lt 1 lw 1\n"
                        << "set border lw 1.2 lc rgb '#606060'\n"
                        << "set tics textcolor rgb '#303030'\nset datafile missing NaN\n"
                        << "set multiplot layout 1," << titles.size() << " margins screen "
                        << kLeft / width << "," << 1 - kRight / width
                        << ",0.25,0.93 spacing screen " << kGap / width << "\n"
                        << "set xlabel '" << xLabel << "'\nset ylabel '" << yLabel << "'\n"
                        << "set key at screen 0.5,0.01 bottom center horizontal samplen 1.5\n";
    }

    viz::CGnuplot& plot() { return m_plot; }

    /// Appends a curve to the next panel; only those of the first panel are in the legend.
    void add(const std::string& curve, const std::string& title) {
        m_curves += (m_curves.empty() ? "plot " : ", ") + curve +
                    (m_panel == 0 && !title.empty() ? " title '" + title + "'" : " notitle");
    }

    void drawPanel() {
        m_plot.script() << "set title '" << m_titles[m_panel] << "'\n"
                        << m_curves << "\n"
                        << "unset ylabel\n";
        m_curves.clear();
        ++m_panel;
    }

    void write(const std::string& file) {
        m_plot.script() << "unset multiplot\n";
        m_plot.run(file);
    }

 private:
    static constexpr double kLeft = 100, kRight = 25, kGap = 55;  // [px]
    static int widthOf(std::size_t panels) { return 200 + 480 * static_cast<int>(panels); }

    Names m_titles;
    viz::CGnuplot m_plot;
    std::string m_curves;
    std::size_t m_panel{0};
};

std::string dataName(std::size_t panel, std::size_t variant) {
    return "d" + std::to_string(panel) + "_" + std::to_string(variant);
}

std::string lineOf(const TVariant& variant) {
    return " lw 2 dt " + std::to_string(variant.stroke + 1) + " lc rgb '" + variant.colour + "'";
}

Names titlesOfLevels(const Names& levels) {
    Names titles;
    for (const auto& level : levels) titles.push_back("odometry noise " + level);
    return titles;
}

/// Smallest and largest ANEES of a curve, with the region of a consistent filter.
std::pair<double, double> rangeOfNees(const Rows& rows, const std::string& world) {
    double low = 0.5, high = 2;
    for (const auto& row : rows)
        for (const auto& point : row.neesCurve)
            if (row.world == world && row.noise != "all" && point.runs > 0) {
                low = std::min({low, point.low, point.anees});
                high = std::max({high, point.high, point.anees});
            }
    return {std::max(0.01, 0.8 * low), 1.25 * high};
}

}  // namespace

void plotSuccess(const Rows& rows, const std::string& file) {
    const Names worlds = worldsOf(rows), levels = levelsOf(rows);
    const auto variants = variantsOf(rows);
    Names titles = worlds;
    for (auto& title : titles)
        if (title == "all") title = "all worlds";
    CPanels panels(titles, "odometry noise", "successful runs [%]");
    const double width = 0.8 / static_cast<double>(variants.size());
    auto& script = panels.plot().script();
    script << "set yrange [0:102]\nset ytics 20\nset xrange [-0.6:" << levels.size() - 0.4 << "]\n"
           << "set xtics (";
    for (std::size_t l = 0; l < levels.size(); ++l)
        script << (l == 0 ? "'" : ", '") << levels[l] << "' " << l;
    script << ")\n";
    for (std::size_t w = 0; w < worlds.size(); ++w) {
        for (std::size_t v = 0; v < variants.size(); ++v) {
            auto& out = panels.plot().data(dataName(w, v));
            for (std::size_t l = 0; l < levels.size(); ++l)
                if (const auto* row = find(rows, worlds[w], levels[l], variants[v]))
                    out << static_cast<double>(l) - 0.4 + (static_cast<double>(v) + 0.5) * width
                        << " " << 100 * row->success.share() << " " << 100 * row->success.low << " "
                        << 100 * row->success.high << " " << width * 0.9 << "\n";
            panels.plot().endData();
            const std::string name = "$" + dataName(w, v);
            panels.add(name + " using 1:2:5 with boxes fs solid " +
                           (variants[v].stroke == 0 ? "0.8" : "0.4") + " noborder lc rgb '" +
                           variants[v].colour + "'",
                       variants[v].title);
            panels.add(name +
                           " using 1:3:(0):($4-$3) with vectors heads size screen 0.004,90 lw 1.5 "
                           "lc rgb '#303030'",
                       "");
        }
        panels.drawPanel();
    }
    panels.write(file);
}

void plotErrors(const Rows& rows, const TStudyLimits& limits, const std::string& file) {
    const std::string world = worldsOf(rows).back();  // all together, where there are several
    const Names levels = levelsOf(rows);
    const auto variants = variantsOf(rows);
    CPanels panels(titlesOfLevels(levels), "ATE over the last lap [m]", "runs at or below [%]");
    panels.plot().script() << "set yrange [0:102]\nset ytics 20\nset logscale x\n"
                           << "set xrange [0.005:50]\nset arrow 1 from " << limits.maxAte
                           << ",0 to " << limits.maxAte << ",102 nohead dt 2 lc rgb '#606060'\n";
    for (std::size_t l = 0; l < levels.size(); ++l) {
        for (std::size_t v = 0; v < variants.size(); ++v) {
            auto& out = panels.plot().data(dataName(l, v));
            out << "1e-6 0\n";
            double share = 0;
            if (const auto* row = find(rows, world, levels[l], variants[v]))
                for (const double error : row->lastLapErrors)
                    if (std::isfinite(error))
                        out << error << " "
                            << (share += 100 / static_cast<double>(row->lastLapErrors.size()))
                            << "\n";
            out << "1e6 " << share << "\n";
            panels.plot().endData();
            panels.add("$" + dataName(l, v) + " using 1:2 with steps" + lineOf(variants[v]),
                       variants[v].title);
        }
        panels.drawPanel();
    }
    panels.write(file);
}

void plotConsistency(const Rows& rows, const std::string& file) {
    const std::string world = worldsOf(rows).back();
    const Names levels = levelsOf(rows);
    const auto variants = variantsOf(rows);
    const auto [low, high] = rangeOfNees(rows, world);
    CPanels panels(titlesOfLevels(levels), "share of the drive [%]",
                   "ANEES of the pose (1: consistent)");
    panels.plot().script() << "set logscale y\nset xrange [0:100]\nset yrange [" << low << ":"
                           << high << "]\n";
    for (std::size_t l = 0; l < levels.size(); ++l) {
        for (std::size_t v = 0; v < variants.size(); ++v) {
            auto& out = panels.plot().data(dataName(l, v));
            out << "-1 1 1 1\n";  // left of the axis, so that a panel without data can be drawn
            if (const auto* row = find(rows, world, levels[l], variants[v]))
                for (std::size_t i = 0; i < row->neesCurve.size(); ++i)
                    if (const TNeesPoint& point = row->neesCurve[i]; point.runs > 0)
                        out << 100 * static_cast<double>(i + 1) /
                                   static_cast<double>(row->neesCurve.size())
                            << " " << point.anees << " " << point.low << " " << point.high << "\n";
            panels.plot().endData();
            const std::string name = "$" + dataName(l, v);
            if (v == 0)  // of all variants, which have the same runs but for those that failed
                panels.add(name +
                               " every ::1 using 1:3:4 with filledcurves fs solid 0.5 "
                               "lc rgb '#c9d7f0'",
                           "95 % region");
            panels.add(name + " every ::1 using 1:2 with lines" + lineOf(variants[v]),
                       variants[v].title);
        }
        panels.drawPanel();
    }
    panels.write(file);
}

}  // namespace salma::apps
