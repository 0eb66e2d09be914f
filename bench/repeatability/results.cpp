// SPDX-License-Identifier: BSD-3-Clause
#include "results.h"

#include <salma/viz/CGnuplot.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <functional>
#include <iomanip>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace salma::bench {
namespace {

std::ofstream create(const std::string& file) {
    std::ofstream out(file);
    if (!out) throw std::runtime_error(file + ": cannot be written");
    return out;
}

void close(std::ofstream& out, const std::string& file) {
    out.close();
    if (!out) throw std::runtime_error(file + ": cannot be written to its end");
}

std::string fixed(double value, int decimals) {
    std::ostringstream out;
    out << std::fixed << std::setprecision(decimals) << value;
    return out.str();
}

/// Values in the order in which they first appear.
std::vector<std::string> distinct(const std::vector<TBenchRow>& rows,
                                  std::string TBenchRow::*member) {
    std::vector<std::string> values;
    for (const auto& row : rows)
        if (std::find(values.begin(), values.end(), row.*member) == values.end())
            values.push_back(row.*member);
    return values;
}

std::vector<TBenchRow> select(const std::vector<TBenchRow>& rows,
                              std::string TBenchRow::*member,
                              const std::string& value) {
    std::vector<TBenchRow> selected;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(selected),
                 [&](const TBenchRow& row) { return row.*member == value; });
    return selected;
}

std::string plainCell(const TBenchRow& row) {
    return fixed(100 * row.result.rate(), 1) + " (" +
           std::to_string(row.result.correspondences.size()) + ")";
}

std::string nonRedundantCell(const TBenchRow& row) {
    return fixed(100 * row.result.nonRedundantRate(), 1) + " (" +
           fixed(row.result.nonRedundantCorrespondences, 0) + ")";
}

/// A line of a table: what stands before, then a cell for each row.
void writeLine(std::ostream& out,
               const std::string& title,
               const std::vector<TBenchRow>& rows,
               const std::function<std::string(const TBenchRow&)>& cell) {
    out << "| " << title << " |";
    for (const auto& row : rows) out << " " << cell(row) << " |";
    out << "\n";
}

/// All detectors at all points, against the pictures of one set.
void writeTable(std::ostream& out,
                const std::vector<TBenchRow>& ofSet,
                const std::string& title,
                const std::function<std::string(const TBenchRow&)>& cell) {
    const auto points = distinct(ofSet, &TBenchRow::point);
    const auto detectors = distinct(ofSet, &TBenchRow::detector);
    const auto ofFirst =
        select(select(ofSet, &TBenchRow::point, points[0]), &TBenchRow::detector, detectors[0]);
    out << title << "\n\n";
    writeLine(out, "pictures", ofFirst,
              [](const TBenchRow& row) { return "1-" + std::to_string(row.picture); });
    writeLine(out, "---", ofFirst, [](const TBenchRow&) { return "---"; });
    for (const auto& point : points)
        for (const auto& detector : detectors)
            writeLine(
                out, std::string(detector).append(", ").append(point),
                select(select(ofSet, &TBenchRow::point, point), &TBenchRow::detector, detector),
                cell);
    out << "\n";
}

/// How the views of a set differ.
void writeChanges(std::ostream& out, const std::vector<TBenchRow>& ofSet) {
    out << "Scale and stretch at the middle of picture 1:";
    for (const auto& row : ofSet)
        if (row.point == ofSet[0].point && row.detector == ofSet[0].detector)
            out << (row.picture > 2 ? "; 1-" : " 1-") << row.picture << " "
                << fixed(row.change.scale, 2) << ", " << fixed(row.change.stretch, 2);
    out << ".\n\n";
}

void drawPanel(viz::CGnuplot& plot,
               const std::vector<TBenchRow>& rows,
               const TPanel& panel,
               std::size_t index) {
    constexpr std::array<const char*, 5> kColours = {"#d62728", "#1f5fd0", "#2ca02c", "#9467bd",
                                                     "#8c564b"};
    const auto ofPanel =
        select(select(rows, &TBenchRow::set, panel.set), &TBenchRow::point, panel.point);
    const auto detectors = distinct(ofPanel, &TBenchRow::detector);
    std::ostringstream elements;
    for (std::size_t d = 0; d < detectors.size(); ++d) {
        const std::string name = "panel" + std::to_string(index) + "_" + std::to_string(d);
        auto& data = plot.data(name);
        for (const auto& row : select(ofPanel, &TBenchRow::detector, detectors[d]))
            data << row.picture << " " << 100 * row.result.rate() << " "
                 << 100 * row.result.nonRedundantRate() << "\n";
        plot.endData();
        std::ostringstream style;
        style << " lw 2 ps 1.1 pt " << 5 + 2 * d << " lc rgb '" << kColours[d % kColours.size()]
              << "' ";
        elements << (d == 0 ? "" : ", ") << "$" << name << " using 1:2 with linespoints dt 1"
                 << style.str() << "title '" << detectors[d] << "', $" << name
                 << " using 1:3 with linespoints dt 2" << style.str() << "notitle";
    }
    plot.script() << "set title '" << panel.title << "'\nplot " << elements.str() << "\n";
}

}  // namespace

void writeCsv(const std::vector<TBenchRow>& rows, const std::string& file) {
    auto out = create(file);
    out << "set,detector,point,picture,scale,stretch,first_regions,second_regions,first_common,"
           "second_common,correspondences,repeatability,first_nonredundant,second_nonredundant,"
           "nonredundant_correspondences,nonredundant_repeatability,chance\n"
        << std::setprecision(9);
    for (const auto& row : rows) {
        const auto& r = row.result;
        out << row.set << "," << row.detector << "," << row.point << "," << row.picture << ","
            << row.change.scale << "," << row.change.stretch << "," << row.firstRegions << ","
            << row.secondRegions << "," << r.firstCommon << "," << r.secondCommon << ","
            << r.correspondences.size() << "," << r.rate() << "," << r.firstNonRedundant << ","
            << r.secondNonRedundant << "," << r.nonRedundantCorrespondences << ","
            << r.nonRedundantRate() << "," << row.chance << "\n";
    }
    close(out, file);
}

void writeMarkdown(const std::vector<TBenchRow>& rows,
                   const CRepeatabilityBench& bench,
                   const std::string& file) {
    auto out = create(file);
    out << "# Repeatability\n\n"
        << "Overlap error below " << fixed(100 * bench.options().maxOverlapError, 0)
        << " %, regions brought to a radius of 30 px, one to one. Points: \"default\", each "
           "detector with its default options; \"strongest\", the "
        << bench.options().strongest << " strongest regions of each picture.\n\n";
    for (const auto& detector : bench.detectors())
        out << "- " << detector.name << ": " << detector.meaning << "; window "
            << fixed(detector.windowScale, 0) << " times the region\n";
    for (const auto& set : distinct(rows, &TBenchRow::set)) {
        const auto ofSet = select(rows, &TBenchRow::set, set);
        out << "\n## " << set << "\n";
        writeChanges(out, ofSet);
        writeTable(out, ofSet, "Repeatability in % (correspondences)", plainCell);
        writeTable(out, ofSet, "Non-redundant repeatability in % (non-redundant correspondences)",
                   nonRedundantCell);
        writeTable(out, ofSet,
                   "Repeatability in % by chance: the other picture's regions turned by 180 "
                   "degrees about its middle",
                   [](const TBenchRow& row) { return fixed(100 * row.chance, 1); });
        writeTable(out, ofSet, "Regions of picture 1 and of the other that both show whole",
                   [](const TBenchRow& row) {
                       return std::to_string(row.result.firstCommon) + ", " +
                              std::to_string(row.result.secondCommon);
                   });
    }
    close(out, file);
}

void plotRepeatability(const std::vector<TBenchRow>& rows,
                       const std::vector<TPanel>& panels,
                       const std::string& file) {
    viz::CGnuplot plot(static_cast<int>(360 * panels.size()), 380);
    std::size_t last = 2;
    for (const auto& row : rows) last = std::max(last, row.picture);
    plot.script() << "set multiplot layout 1," << panels.size() << "\n"
                  << "set xrange [1.8:" << static_cast<double>(last) + 0.2 << "]\n"
                  << "set xtics 1 format '1-%g'\nset xlabel 'pictures'\n"
                  << "set yrange [0:100]\nset ylabel '%; dashed: non-redundant' offset 1,0\n"
                  << "set grid lc rgb '#e0e0e0' lt 1 lw 1\nset key below samplen 2\n";
    for (std::size_t i = 0; i < panels.size(); ++i) drawPanel(plot, rows, panels[i], i);
    plot.script() << "unset multiplot\n";
    plot.run(file);
}

}  // namespace salma::bench
