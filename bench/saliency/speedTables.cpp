// SPDX-License-Identifier: BSD-3-Clause
#include "speedTables.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

namespace salma::bench {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double secondsOf(const TCase& which, const CTimes& times) {
    const auto time = times.find(which.name());
    return time ? time->seconds : kNone;
}

double secondsOf(TCase which, const std::string& method, const CTimes& times) {
    which.method = method;
    which.yMin = 0;
    return secondsOf(which, times);
}

double pixelsOf(const TCase& c) {
    const bool whole = c.method == "SIFT" || c.method == "MSER";
    const int edge = whole ? 0 : 2 * c.scaleMax;
    return double(c.size.width - edge) * (c.size.height - edge);
}

std::string cell(double value, int decimals) {
    if (std::isnan(value)) return "";
    std::ostringstream out;
    out << std::fixed << std::setprecision(decimals) << value;
    return out.str();
}

std::string limitOf(const TCase& c) {
    if (!c.isOurs() || c.yMin == 0) return "all";
    std::ostringstream out;
    out << "Y >= " << c.yMin;
    return out.str();
}

}  // namespace

std::vector<TSpeedRow> speedRows(const std::vector<TCase>& cases,
                                 const CTimes& times,
                                 double clock) {
    std::vector<TSpeedRow> rows;
    for (const TCase& c : cases) {
        const auto time = times.find(c.name());
        if (!time) continue;
        TCase alone = c;
        alone.threads = 1;
        TSpeedRow row{c, time->regions};
        row.ms = 1000 * time->seconds;
        row.bySift = time->seconds / secondsOf(c, "SIFT", times);
        row.byMser = time->seconds / secondsOf(c, "MSER", times);
        row.plainBy = secondsOf(alone, "plain", times) / time->seconds;
        row.oneThreadBy = c.threads > 1 ? secondsOf(alone, times) / time->seconds : kNone;
        row.cycles = time->seconds * c.threads * clock / pixelsOf(c);
        rows.push_back(row);
    }
    return rows;
}

void printSpeed(const std::vector<TSpeedRow>& rows, std::ostream& out) {
    std::string title;
    for (const TSpeedRow& row : rows) {
        const TCase& c = row.which;
        const std::string here = c.picture + ", " + text(c.size);
        if (here != title)
            out << "\n### " << here
                << "\n| method | peaks | threads | regions | ms | by SIFT | by MSER | plain loops "
                   "by it "
                   "| one thread by it | cycles per pixel "
                   "|\n|---|---|---|---|---|---|---|---|---|---|\n";
        title = here;
        out << "| " << c.method << " | " << limitOf(c) << " | " << c.threads << " | " << row.regions
            << " | " << cell(row.ms, 1) << " | " << cell(row.bySift, 2) << " | "
            << cell(row.byMser, 2) << " | " << cell(row.plainBy, 1) << " | "
            << cell(row.oneThreadBy, 2) << " | " << cell(row.cycles, 0) << " |\n";
    }
}

void writeSpeedCsv(const std::vector<TSpeedRow>& rows, const std::string& file) {
    std::ofstream out(file);
    out << "picture,width_px,height_px,method,y_min_nat,threads,scale_max_px,regions,time_ms,by_"
           "sift,"
           "by_mser,plain_by_this,one_thread_by_this,cycles_per_pixel\n";
    for (const TSpeedRow& row : rows) {
        const TCase& c = row.which;
        out << c.picture << "," << c.size.width << "," << c.size.height << "," << c.method << ","
            << c.yMin << "," << c.threads << "," << c.scaleMax << "," << row.regions << ","
            << cell(row.ms, 3) << "," << cell(row.bySift, 3) << "," << cell(row.byMser, 3) << ","
            << cell(row.plainBy, 3) << "," << cell(row.oneThreadBy, 3) << "," << cell(row.cycles, 1)
            << "\n";
    }
    out.close();
    if (!out) throw std::runtime_error(file + ": cannot be written");
}

void printBounds(const std::vector<TBoundRow>& rows, std::ostream& out) {
    if (rows.empty()) return;
    out << "\n### Cycles per centre, all peaks: the bound by stage, and measured\n"
           "| picture | set | bins in a band | bitmaps | counting | joining | last bin | sums | "
           "peaks | "
           "bound | measured | measured by bound "
           "|\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const auto& row : rows) {
        const TBound& b = row.bound;
        out << "| " << row.picture << " | " << row.set << " | "
            << cell(row.work.bandBins / row.work.bands, 1);
        for (const double cycles : {b.bitmaps, b.counting, b.joining, b.rest, b.sums, b.peaks})
            out << " | " << cell(cycles, 1);
        out << " | " << cell(b.total(), 0) << " | " << cell(row.measured, 0) << " | "
            << cell(row.measured / b.total(), 2) << " |\n";
    }
}

void checkSameCounts(const std::vector<TSpeedRow>& rows) {
    std::map<std::string, const TSpeedRow*> first;
    for (const TSpeedRow& row : rows) {
        TCase c = row.which;
        if (c.method == "SIFT" || c.method == "MSER") continue;
        c.method = "auto";
        c.threads = 1;
        const auto [at, isNew] = first.emplace(c.name(), &row);
        if (!isNew && at->second->regions != row.regions)
            throw std::runtime_error(row.which.name() + ": " + std::to_string(row.regions) +
                                     " peaks, but " + at->second->which.name() + ": " +
                                     std::to_string(at->second->regions));
    }
}

}  // namespace salma::bench
