// SPDX-License-Identifier: BSD-3-Clause
#include "studyTable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "CResultFile.h"
#include "CTemporaryFolder.h"
#include "studyFiles.h"

namespace salma::apps {
namespace {

TRunResult madeResult(const std::string& world, const std::string& noise, double error) {
    TRunResult r;
    r.key.world = world;
    r.key.noise = noise;
    r.key.backend = "ekf";
    r.key.method = "nn";
    r.score.ate = r.score.ateLastLap = error;
    r.score.finalError = error;
    r.score.maxJump = 0.1;
    r.score.nees = 3;
    r.score.neesAt = std::vector<double>(20, 3.0);
    return r;
}

/// Four runs in two worlds; one fails, one is lost.
std::vector<TRunResult> someResults() {
    std::vector<TRunResult> results{madeResult("a", "low", 0.1), madeResult("a", "low", 0.2),
                                    madeResult("b", "low", 5), madeResult("b", "low", 0.1)};
    results[0].score.salient = {9, 10, 8, 16};  // right, judged, recalled, re-sightings
    results[0].score.salient.wrong = 1;
    results[1].score.salient = {10, 10, 4, 4};
    results[1].score.corners = {80, 100, 70, 80};
    results[1].score.corners.wrong = 15;
    results[1].score.corners.wrongWithFalse = 5;
    results[2].score.relocations = 2;
    results[3].failure = "crashed";
    return results;
}

TEST(StudyTable, CountsAFailedRunAsNoSuccess) {
    const auto rows = studyTable(someResults(), {});
    ASSERT_EQ(rows.size(), 3u) << "each world, then both";
    EXPECT_EQ(rows[0].world, "a");
    EXPECT_EQ(rows[1].world, "b");
    EXPECT_EQ(rows[1].runs, 2u);
    EXPECT_EQ(rows[1].failed, 1u);
    EXPECT_EQ(rows[1].success.count, 0u);
    EXPECT_EQ(rows[1].success.total, 2u);
    EXPECT_EQ(rows[1].lost.count, 1u);
    EXPECT_EQ(rows[1].lost.total, 1u) << "where a run ended is known of those that did";
    EXPECT_EQ(rows[1].wrongLoop.count, 1u);
    EXPECT_TRUE(std::isinf(rows[1].medianAteLastLap));
    const auto& all = rows[2];
    EXPECT_EQ(all.world, "all");
    EXPECT_EQ(all.noise, "low");
    EXPECT_EQ(all.success.count, 2u);
    EXPECT_EQ(all.success.total, 4u);
    EXPECT_EQ(all.relocations, 2u);
    EXPECT_NEAR(all.ateLastLap.mean, (0.1 + 0.2 + 5) / 3, 1e-12);
}

TEST(StudyTable, PoolsPairingsOfAllRuns) {
    const auto row = studyTable(someResults(), {})[0];
    EXPECT_EQ(row.salientPrecision.count, 19u);
    EXPECT_EQ(row.salientPrecision.total, 20u);
    EXPECT_EQ(row.cornerPrecision.count, 80u);
    EXPECT_EQ(row.precision.count, 99u);
    EXPECT_EQ(row.precision.total, 120u);
    EXPECT_EQ(row.salientRecall.count, 12u);
    EXPECT_EQ(row.salientRecall.total, 20u);
    EXPECT_EQ(row.recall.count, 82u);
    EXPECT_NEAR(row.wrongSalient.mean, 0.5, 1e-12);
    EXPECT_NEAR(row.wrongCorners.mean, 10, 1e-12);
    EXPECT_EQ(row.noWrongPoster.count, 1u);
}

TEST(StudyTable, TellsAConsistentFilterByTheChiSquareRegion) {
    auto results = someResults();
    results.resize(2);
    auto row = studyTable(results, {})[0];
    EXPECT_DOUBLE_EQ(row.anees.mean, 1);
    EXPECT_EQ(row.neesInside.count, 20u);
    // chi2(0.025, 6) = 1.2373, chi2(0.975, 6) = 14.4494 (tables)
    EXPECT_NEAR(row.neesCurve[0].low, 1.2373 / 6, 1e-4);
    EXPECT_NEAR(row.neesCurve[0].high, 14.4494 / 6, 1e-4);
    for (auto& result : results) result.score.neesAt.assign(20, 7.3);
    EXPECT_EQ(studyTable(results, {})[0].neesInside.count, 0u);
    for (auto& result : results) result.score.neesAt.assign(20, std::nan(""));
    EXPECT_EQ(studyTable(results, {})[0].neesInside.total, 0u);
}

TEST(StudyTable, AWrongLoopShowsInPairingsJumpsOrTheEnd) {
    TRunScore score = madeResult("a", "low", 0.1).score;
    const TStudyLimits limits;
    EXPECT_FALSE(closedWrongLoop(score, limits));
    TRunScore wrong = score;
    wrong.repeatedWrongPairs = 1;
    EXPECT_TRUE(closedWrongLoop(wrong, limits));
    wrong = score;
    wrong.maxJump = 1.3;
    EXPECT_TRUE(closedWrongLoop(wrong, limits));
    wrong = score;
    wrong.finalError = 1.3;
    EXPECT_TRUE(closedWrongLoop(wrong, limits));
    wrong.finalError = TRunScore::kNone;
    EXPECT_TRUE(closedWrongLoop(wrong, limits)) << "what is not known is not right";
}

TEST(StudyTable, AWrongLoopWithCopiesIsAWrongLoopAndAPairingOfCopies) {
    std::vector<TRunResult> results(4, madeResult("a", "low", 0.1));
    results[1].score.wrongCopies = 3;  // noticed in time
    results[2].score.finalError = 5;   // but for another reason
    results[3].score.wrongCopies = 1;
    results[3].score.finalError = 5;
    const auto row = studyTable(results, {})[0];
    EXPECT_EQ(row.wrongLoop.count, 2u);
    EXPECT_EQ(row.wrongLoopWithCopies.count, 1u);
    EXPECT_EQ(row.wrongLoopWithCopies.total, 4u);
    const std::string runs = runsCsv(results, {});
    EXPECT_NE(runs.find(",wrong_loop,wrong_loop_with_copies,"), std::string::npos);
    EXPECT_NE(runs.find("a,low,ekf,nn,0,,1,0,"), std::string::npos) << runs;
    EXPECT_NE(runs.find("a,low,ekf,nn,0,,1,1,"), std::string::npos) << runs;
}

TEST(StudyTable, ALapThatIsRightInItselfButOnAWrongPlaceIsNoSuccess) {
    TRunScore score = madeResult("a", "low", 0.1).score;
    EXPECT_TRUE(succeeded(score, {}));
    score.finalError = 2.5;
    EXPECT_FALSE(succeeded(score, {}));
    score = madeResult("a", "low", 0.31).score;
    EXPECT_FALSE(succeeded(score, {}));
    score.ateLastLap = TRunScore::kNone;
    EXPECT_FALSE(succeeded(score, {}));
}

TEST(StudyFiles, HoldAsManyCellsAsColumns) {
    auto results = someResults();
    results[3].failure = "no such file, \"x\"";
    const auto rows = studyTable(results, {});
    for (const auto& text : {studyCsv(rows), runsCsv(results, {}), timesCsv(results)}) {
        std::istringstream lines(text);
        std::string line;
        std::getline(lines, line);
        const auto columns = std::count(line.begin(), line.end(), ',');
        while (std::getline(lines, line)) {
            bool quoted = false;
            std::ptrdiff_t cells = 0;
            for (const char c : line) {
                if (c == '"') quoted = !quoted;
                cells += c == ',' && !quoted;
            }
            EXPECT_EQ(cells, columns) << line;
        }
    }
    EXPECT_NE(runsCsv(results, {}).find("\"no such file, \"\"x\"\"\""), std::string::npos);
}

TEST(StudyFiles, DrawWhatHasNoRunThatEnded) {
    const test::CTemporaryFolder folder;
    std::vector<TRunResult> results{madeResult("a", "low", 0.1)};
    results[0] = TRunResult{results[0].key, "", "crashed", 0, 0, {}};
    const auto rows = studyTable(results, {});
    for (int i = 0; i < 3; ++i) {
        const std::string file = (folder / (std::to_string(i) + ".png")).string();
        if (i == 0) plotSuccess(rows, file);
        if (i == 1) plotErrors(rows, {}, file);
        if (i == 2) plotConsistency(rows, file);
        EXPECT_GT(std::filesystem::file_size(file), 1000u);
    }
}

TEST(ResultFile, ALineReadsBackAsItWas) {
    TRunResult result = someResults()[0];
    result.failure = "file \"x\"\nnot UTF-8: \xff";
    result.score.ate = 0.1 + 0.2;
    result.score.nees = TRunScore::kNone;
    result.score.neesAt = {1, TRunScore::kNone, 1e-300};
    const std::string line = asLine(result);
    EXPECT_EQ(line.find('\n'), std::string::npos);
    const TRunResult back = salma::apps::resultOf(line);
    EXPECT_EQ(asLine(back), line);
    EXPECT_EQ(back.score.ate, result.score.ate);
    EXPECT_TRUE(std::isnan(back.score.nees));
    EXPECT_EQ(back.score.salient.judged, 10u);
}

TEST(ResultFile, IsLockedAgainstASecondStudy) {
    const test::CTemporaryFolder folder;
    CResultFile first(folder / "results.jsonl");
    first.add(someResults()[0]);
    EXPECT_THROW(CResultFile second(folder / "results.jsonl"), std::runtime_error);
}

}  // namespace
}  // namespace salma::apps
