// SPDX-License-Identifier: BSD-3-Clause
// Whatever the method: each decision of a run can be explained from its files.
#include <CProcess.h>
#include <CTemporaryFolder.h>
#include <gtest/gtest.h>
#include <salma/viz/CCsvTable.h>
#include <salma/viz/CRunWriter.h>

#include <cmath>
#include <map>
#include <utility>

namespace salma {
namespace {

using test::CTemporaryFolder;
using test::program;
using test::readFile;
using test::runProcess;

/// A short simulated log with the records of its pictures, made once.
std::string loggedRecords() {
    static const CTemporaryFolder folder;
    static const auto made =
        runProcess({program("salma-sim"), SALMA_SOURCE_DIR "/tests/data/worlds/two-posters.ini",
                    "--out", (folder / "sim").string()});
    EXPECT_EQ(made.exitCode, 0) << made.output;
    static const auto seen = runProcess({program("salma-slam"), SALMA_SOURCE_DIR "/config.ini",
                                         (folder / "sim/two-posters.rawlog").string(), "--out",
                                         (folder / "seen").string(), "--save-rawlog", "--embed"});
    EXPECT_EQ(seen.exitCode, 0) << seen.output;
    return (folder / "seen/two-posters.rawlog").string();
}

/// What candidates.csv says of one observation.
struct TCandidates {
    std::size_t near{0};
    std::size_t inGate{0};
    std::map<int, double> chosen;  //!< Landmark and distance.
    bool compared{false};          //!< Some appearance was.
};
using Key = std::pair<std::string, int>;  // stamp, observation

std::map<Key, TCandidates> candidatesOf(const std::string& file) {
    const viz::CCsvTable table(file, viz::candidateColumns());
    std::map<Key, TCandidates> result;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        auto& of = result[{table.text(i, "t_s"), table.integer(i, "observation")}];
        ++of.near;
        of.inGate += static_cast<std::size_t>(table.integer(i, "in_gate"));
        if (table.integer(i, "chosen") == 1)
            of.chosen[table.integer(i, "landmark_id")] = table.number(i, "d2");
        of.compared = of.compared || !std::isnan(table.numberOrNaN(i, "log_lr"));
    }
    return result;
}

void expectExplained(const std::string& associations, std::map<Key, TCandidates> candidates) {
    const viz::CCsvTable table(associations, viz::associationColumns());
    std::size_t paired = 0;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const std::string verdict = table.text(i, "decision");
        const TCandidates& of = candidates[{table.text(i, "t_s"), table.integer(i, "observation")}];
        EXPECT_EQ(of.inGate, static_cast<std::size_t>(table.integer(i, "n_candidates")));
        if (verdict == "paired") {
            ++paired;
            const std::map<int, double> expected{
                {table.integer(i, "landmark_id"), table.number(i, "d2")}};
            EXPECT_EQ(of.chosen, expected) << "row " << i;
            EXPECT_EQ(table.text(i, "reason"), "nearest");
        } else if (verdict == "deferred") {
            EXPECT_GT(of.near, 0U) << "row " << i << ": nothing to be taken for";
            EXPECT_NE(table.text(i, "reason"), "nearest");
        } else if (verdict == "new") {
            // The filter had a poster that is confirmed now in its state before.
            const std::string reason = table.text(i, "reason");
            EXPECT_TRUE(reason == "unexplained" || reason == "nearest") << reason;
        }
    }
    EXPECT_GT(paired, 20U);
}

/// Runs one method on the log and looks at what it leaves.
void expectExplainedRun(const std::string& backend, const std::string& method) {
    SCOPED_TRACE(backend + " with " + method);
    const CTemporaryFolder folder;
    const auto ini = folder.write("p.ini", "[rbpf]\nparticles = 5\n");
    const auto run =
        runProcess({program("salma-slam"), ini, loggedRecords(), "--out", (folder / "out").string(),
                    "--backend", backend, "--association", method});
    ASSERT_EQ(run.exitCode, 0) << run.output;
    const auto candidates = candidatesOf((folder / "out/candidates.csv").string());
    expectExplained((folder / "out/associations.csv").string(), candidates);
    bool compared = false;
    for (const auto& [key, of] : candidates) compared = compared || of.compared;
    EXPECT_EQ(compared, method == "saliency") << "only saliency looks at appearance";
    const std::string report = readFile(folder / "out/report.html");
    EXPECT_NE(report.find("alt=\"patch as seen\""), std::string::npos);
    EXPECT_NE(report.find("alt=\"patch of landmark "), std::string::npos);
}

TEST(Explained, EveryDecisionOfTheFilterAndTheDoubtfulOnesInTheReport) {
    for (const auto* method : {"nn", "scnn", "jcbb", "saliency"}) expectExplainedRun("ekf", method);
}

TEST(Explained, EveryDecisionOfTheParticlesAndTheDoubtfulOnesInTheReport) {
    for (const auto* method : {"nn", "scnn", "jcbb", "saliency"})
        expectExplainedRun("rbpf", method);
}

}  // namespace
}  // namespace salma
