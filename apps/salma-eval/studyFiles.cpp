// SPDX-License-Identifier: BSD-3-Clause
#include "studyFiles.h"

#include <array>
#include <charconv>
#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

namespace salma::apps {
namespace {

using nlohmann::ordered_json;

/// Shortest text that reads back the same; "" for NaN.
std::string number(double value) {
    if (std::isnan(value)) return "";
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
}

std::string cell(const std::string& text) {
    if (text.find_first_of(",\"") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

/// Collects the names or the values of a row of CSV.
class CCsvLine {
 public:
    explicit CCsvLine(bool names) : m_names(names) {}

    void operator()(const std::string& name, const std::string& value) { add(name, cell(value)); }
    void operator()(const std::string& name, double value) { add(name, number(value)); }
    void operator()(const std::string& name, std::uint64_t value) {
        add(name, std::to_string(value));
    }
    void operator()(const std::string& name, const std::vector<double>& values) {
        for (std::size_t i = 0; i < values.size(); ++i)
            add(name + "_" + std::to_string(i), number(values[i]));
    }
    void operator()(const std::string& name, const TProportion& p) {
        (*this)(name, p.share());
        (*this)(name + "_count", std::uint64_t{p.count});
        (*this)(name + "_total", std::uint64_t{p.total});
        (*this)(name + "_low_95", p.low);
        (*this)(name + "_high_95", p.high);
    }
    void operator()(const std::string& name, const TMean& m) {
        (*this)(name, m.mean);
        (*this)(name + "_low_95", m.low);
        (*this)(name + "_high_95", m.high);
    }
    std::string text() const { return m_text + "\n"; }

 private:
    void add(const std::string& name, const std::string& value) {
        m_text += (m_text.empty() ? "" : ",") + (m_names ? name : value);
    }

    bool m_names;
    std::string m_text;
};

ordered_json asJson(const TProportion& p) {
    return {{"share", p.share()},
            {"count", p.count},
            {"total", p.total},
            {"low_95", p.low},
            {"high_95", p.high}};
}
ordered_json asJson(const TMean& m) {
    return {{"mean", m.mean}, {"low_95", m.low}, {"high_95", m.high}, {"count", m.count}};
}
template <class VALUE>
ordered_json asJson(const VALUE& value) {
    return value;
}

std::string fixed(double value, int decimals) {
    if (!std::isfinite(value)) return std::isnan(value) ? "-" : "inf";
    std::ostringstream out;
    out << std::fixed << std::setprecision(decimals) << value;
    return out.str();
}

std::string percent(const TProportion& p, int decimals) {
    if (p.total == 0) return "-";
    return fixed(100 * p.share(), decimals) + " (" + fixed(100 * p.low, decimals) + "-" +
           fixed(100 * p.high, decimals) + ")";
}

std::string counted(const TProportion& p) {
    if (p.total == 0) return "-";
    return std::to_string(p.count) + "/" + std::to_string(p.total) + " = " + percent(p, 1);
}

std::string withInterval(const TMean& m, int decimals) {
    const std::string text = fixed(m.mean, decimals);
    return std::isnan(m.low) ? text : text + " ± " + fixed(m.high - m.mean, decimals);
}

using Cells = std::vector<std::string>;

void writeRow(std::ostream& out, const Cells& cells) {
    for (const auto& text : cells) out << "| " << text << " ";
    out << "|\n";
}

/// A table whose rows begin with what names them.
template <class CELLS_OF>
void writeTable(std::ostream& out,
                const std::vector<TStudyRow>& rows,
                const Cells& columns,
                const CELLS_OF& cellsOf) {
    Cells names{"world", "noise", "back end", "method"};
    names.insert(names.end(), columns.begin(), columns.end());
    writeRow(out, names);
    writeRow(out, Cells(names.size(), "---"));
    for (const auto& row : rows) {
        Cells cells{row.world, row.noise, row.backend, row.method};
        for (const auto& text : cellsOf(row)) cells.push_back(text);
        writeRow(out, cells);
    }
    out << "\n";
}

void writeMeaning(std::ostream& out, const TStudyLimits& limits) {
    const std::string half = fixed(limits.doorSpacing / 2, 2);
    out << "- Numbers in brackets and behind ± are 95 % intervals: Clopper-Pearson for shares, "
           "Student's over runs for means. Those of\n  pairings and sightings take each as "
           "independent, which those of one run are not: they are too narrow.\n"
        << "- Success: ATE below " << fixed(limits.maxAte, 2)
        << " m over the last lap, and not lost; a run that failed is none. Lost: the last position "
           "is more than\n  "
        << half << " m off, half the spacing of doors, in the frame of the first pose.\n"
        << "- Wrong loop: a salient landmark that stands for one thing was paired with one other "
           "in two steps or more, or one step\n  moved the estimate by more than "
        << half
        << " m away from the truth, or the run ended lost. With copies: of all runs, those with a "
           "wrong loop in which a poster\n  was also paired with a copy of it, a poster with the "
           "same texture that hangs elsewhere.\n"
        << "- Precision: right pairings of those that the truth can judge, with entities that show "
           "nothing true counted as wrong where\n  one side is true. Recall: of the sightings of "
           "landmarks made in an earlier step, those paired rightly.\n"
        << "- Made / true: landmarks of a run, and of the world; duplicates stand for one that "
           "the map has already.\n"
        << "- ANEES: mean over runs of the run's mean pose NEES divided by 3, 1 is consistent. "
           "Inside: places of the course, of 20, whose\n  ANEES over the runs is inside the 95 % "
           "region of a consistent filter.\n";
}

}  // namespace

std::string studyCsv(const std::vector<TStudyRow>& rows) {
    CCsvLine names(true);
    TStudyRow::forEach(rows.empty() ? TStudyRow() : rows.front(),
                       [&](const auto& name, const auto& value) { names(name, value); });
    std::string text = names.text();
    for (const auto& row : rows) {
        CCsvLine line(false);
        TStudyRow::forEach(row, [&](const auto& name, const auto& value) { line(name, value); });
        text += line.text();
    }
    return text;
}

std::string studyJson(const std::vector<TStudyRow>& rows, const TStudyLimits& limits) {
    ordered_json json{{"max_ate_m", limits.maxAte}, {"door_spacing_m", limits.doorSpacing}};
    json["rows"] = ordered_json::array();
    for (const auto& row : rows) {
        ordered_json entry;
        TStudyRow::forEach(
            row, [&](const auto& name, const auto& value) { entry[name] = asJson(value); });
        entry["anees_curve"] = ordered_json::array();
        for (const auto& point : row.neesCurve)
            entry["anees_curve"].push_back({{"runs", point.runs},
                                            {"anees", point.anees},
                                            {"low_95", point.low},
                                            {"high_95", point.high}});
        json["rows"].push_back(entry);
    }
    return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string studyMarkdown(const std::vector<TStudyRow>& rows, const TStudyLimits& limits) {
    std::ostringstream out;
    out << "# Success\n";
    writeTable(out, rows,
               {"failed", "success [%]", "wrong loop [%]", "with copies [%]", "lost [%]",
                "ATE last lap, median [m]", "ATE last lap [m]", "same, path aligned [m]", "ATE [m]",
                "odometry alone [m]"},
               [](const TStudyRow& r) -> Cells {
                   return {std::to_string(r.failed),
                           counted(r.success),
                           percent(r.wrongLoop, 1),
                           percent(r.wrongLoopWithCopies, 1),
                           percent(r.lost, 1),
                           fixed(r.medianAteLastLap, 3),
                           withInterval(r.ateLastLap, 3),
                           withInterval(r.lastLapInPath, 3),
                           withInterval(r.ate, 3),
                           fixed(r.ateOdometry.mean, 3)};
               });
    out << "# Association\n";
    writeTable(
        out, rows,
        {"precision [%]", "salient [%]", "corners [%]", "recall [%]", "salient [%]", "corners [%]",
         "wrong per run: salient", "corners", "runs without wrong poster [%]"},
        [](const TStudyRow& r) -> Cells {
            return {percent(r.precision, 2),         percent(r.salientPrecision, 2),
                    percent(r.cornerPrecision, 2),   percent(r.recall, 2),
                    percent(r.salientRecall, 2),     percent(r.cornerRecall, 2),
                    withInterval(r.wrongSalient, 2), withInterval(r.wrongCorners, 2),
                    percent(r.noWrongPoster, 1)};
        });
    out << "# Map and consistency\n";
    writeTable(out, rows,
               {"salient made / true", "duplicates", "corners made / true", "duplicates",
                "relocations", "RPE over 1 m [m]", "ANEES", "inside [%]"},
               [](const TStudyRow& r) -> Cells {
                   return {withInterval(r.salientMade, 1) + " / " + fixed(r.salientTrue.mean, 1),
                           withInterval(r.salientDuplicates, 2),
                           withInterval(r.cornersMade, 1) + " / " + fixed(r.cornersTrue.mean, 1),
                           withInterval(r.cornerDuplicates, 2),
                           std::to_string(r.relocations),
                           withInterval(r.rpePosition, 4),
                           withInterval(r.anees, 2),
                           percent(r.neesInside, 0)};
               });
    out << "# Meaning\n";
    writeMeaning(out, limits);
    return out.str();
}

std::string runsCsv(const std::vector<TRunResult>& results, const TStudyLimits& limits) {
    const auto write = [&](const TRunResult& result, CCsvLine& line) {
        line("world", result.key.world);
        line("noise", result.key.noise);
        line("backend", result.key.backend);
        line("method", result.key.method);
        line("seed", std::uint64_t{result.key.seed});
        line("failure", result.failure);
        const bool known = !result.failed();
        line("wrong_loop", std::uint64_t{known && closedWrongLoop(result.score, limits)});
        line("wrong_loop_with_copies",
             std::uint64_t{known && closedWrongLoopWithCopies(result.score, limits)});
        TRunScore::forEach(result.score,
                           [&](const auto& name, const auto& value) { line(name, value); });
    };
    std::string text;
    for (const auto& result : results) {
        CCsvLine names(true), line(false);
        if (text.empty()) write(result, names);
        if (text.empty()) text = names.text();
        write(result, line);
        text += line.text();
    }
    return text;
}

std::string timesCsv(const std::vector<TRunResult>& results) {
    std::string text = "world,noise,backend,method,seed,steps,cpu_s,mapping_cpu_s\n";
    for (const auto& r : results)
        text += cell(r.key.world) + "," + r.key.noise + "," + r.key.backend + "," + r.key.method +
                "," + std::to_string(r.key.seed) + "," + std::to_string(r.score.steps) + "," +
                number(r.cpuSeconds) + "," + number(r.mappingSeconds) + "\n";
    return text;
}

}  // namespace salma::apps
