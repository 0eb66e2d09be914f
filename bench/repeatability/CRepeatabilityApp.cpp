// SPDX-License-Identifier: BSD-3-Clause
#include "CRepeatabilityApp.h"

#include <set>
#include <stdexcept>

#include "COutputFolder.h"
#include "results.h"

namespace salma::bench {
namespace {

std::vector<TPictureSet> readSets(const std::vector<std::string>& folders) {
    std::vector<TPictureSet> sets;
    std::set<std::string> names;
    for (const auto& folder : folders) {
        sets.push_back(readPictureSet(folder));
        if (sets.back().name.find_first_of(",|'\"\\\n`") != std::string::npos)
            throw std::invalid_argument(
                folder + ": tables and figures cannot carry a name with a comma, bar or quote");
        if (!names.insert(sets.back().name).second)
            throw std::invalid_argument(folder + ": another set is named " + sets.back().name +
                                        " too");
    }
    return sets;
}

}  // namespace

CRepeatabilityApp::CRepeatabilityApp(CLI::App& app) {
    app.add_option("FOLDER", m_folders,
                   "sets of pictures with homographies, as VGG's (img1.ppm, H1to2p) or HPatches' "
                   "(1.png, H_1_2)")
        ->required();
    app.add_option("--out", m_out, "folder for the results")->required();
    app.add_option("--strongest", m_options.strongest,
                   "regions of each picture at the second operating point (default 500)")
        ->check(CLI::Range(1, 1000000));
    app.add_option("--max-overlap-error", m_options.maxOverlapError,
                   "overlap error below which regions correspond (default 0.4)");
    app.add_option("--threads", m_options.threads, "threads (default 1, 0: one per core)")
        ->check(CLI::Range(0, 1024));
}

void CRepeatabilityApp::run(std::ostream& out) {
    if (!(m_options.maxOverlapError > 0 && m_options.maxOverlapError < 1))
        throw CLI::ValidationError("--max-overlap-error", "must be between 0 and 1");
    const auto sets = readSets(m_folders);
    apps::COutputFolder folder(m_out);
    const CRepeatabilityBench bench(allDetectors(), m_options);
    const std::string strongest = std::to_string(m_options.strongest) + " strongest";
    std::vector<TBenchRow> rows;
    std::vector<TPanel> ofSets;
    for (const auto& set : sets) {
        for (auto& row : bench.run(set, folder / "regions")) rows.push_back(std::move(row));
        plotRepeatability(rows,
                          {{set.name, "default", set.name + ", default options"},
                           {set.name, "strongest", set.name + ", " + strongest}},
                          folder / (set.name + ".png"));
        ofSets.push_back({set.name, "strongest", set.name + ", " + strongest});
        out << set.name << ": " << set.pictures.size() << " pictures\n";
    }
    plotRepeatability(rows, ofSets, folder / "sets.png");
    writeCsv(rows, folder / "repeatability.csv");
    writeMarkdown(rows, bench, folder / "repeatability.md");
    folder.publish();
    out << "tables " << m_out << "/repeatability.md\n";
}

}  // namespace salma::bench
