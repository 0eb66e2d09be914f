// SPDX-License-Identifier: BSD-3-Clause
#include <CTemporaryFolder.h>
#include <gtest/gtest.h>
#include <salma/viz/CReport.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "exampleRun.h"

namespace salma::viz {
namespace {

std::string reportOf(const TReportInput& input) {
    const test::CTemporaryFolder folder;
    const std::string figure = folder.write("figure.png", "not looked into");
    return CReport(input).html({figure, figure});
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
}

/// The first problem with the nesting of the elements; "" if there is none.
std::string nestingProblem(const std::string& html) {
    std::vector<std::string> open;
    for (auto at = html.find('<'); at != std::string::npos; at = html.find('<', at + 1)) {
        const bool closing = html[at + 1] == '/';
        const auto from = at + (closing ? 2 : 1);
        const std::string name = html.substr(from, html.find_first_of(" >", from) - from);
        if (name == "!DOCTYPE" || name == "meta" || name == "img") continue;
        if (!closing) {
            open.push_back(name);
        } else if (open.empty() || open.back() != name) {
            return "</" + name + "> closes " + (open.empty() ? "nothing" : open.back());
        } else {
            open.pop_back();
        }
    }
    return open.empty() ? "" : open.back() + " stays open";
}

TEST(CReport, EncodesTheVectorsOfRfc4648) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foob"), "Zm9vYg==");
    EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(CReport, EscapesWhatComesFromOutside) {
    auto run = test::hallwayRun();
    run.record.notices = {"<script>alert(1)</script>"};
    run.record.options = "a = </pre><b>\"x\" & 'y'";
    const std::string html = reportOf({run.record, run.truth});
    EXPECT_EQ(html.find("<script"), std::string::npos);
    EXPECT_NE(html.find("&lt;script&gt;alert(1)&lt;/script&gt;"), std::string::npos);
    EXPECT_NE(html.find("a = &lt;/pre&gt;&lt;b&gt;&quot;x&quot; &amp; &#39;y&#39;"),
              std::string::npos);
    EXPECT_NE(html.find("<h1>hallway &amp; &lt;loop&gt;.rawlog</h1>"), std::string::npos);
}

TEST(CReport, NeedsNothingBesideIt) {
    const auto run = test::hallwayRun();
    const std::string html = reportOf({run.record, run.truth});
    EXPECT_EQ(count(html, "<img"), 13U) << "two figures, six landmarks, five doubtful pairings";
    EXPECT_EQ(count(html, "src=\"data:image/png;base64,"), 13U);
    EXPECT_EQ(count(html, "http"), 0U);
    EXPECT_EQ(count(html, "<link"), 0U);
    EXPECT_NE(html.find("base64," + base64("not looked into")), std::string::npos);
    EXPECT_EQ(nestingProblem(html), "");
}

TEST(CReport, TellsTheHeadlineFiguresAndEverySalientLandmark) {
    const auto run = test::hallwayRun();
    const std::string html = reportOf({run.record, run.truth});
    for (const auto* tile :
         {"<b>6</b><span>salient landmarks", "<b>18</b><span>corners", "<b>300</b><span>pictures<",
          "<b>120</b><span>pictures without landmark", "<b>42.5</b><span>seconds",
          "<b>7</b><span>seed"})
        EXPECT_NE(html.find(tile), std::string::npos) << tile;
    EXPECT_NE(html.find("<td>18</td><td>5.00 &plusmn; 0.050</td><td>-1.20 &plusmn; 0.040</td>"
                        "<td>0.60 &times; 0.40</td><td>9</td>"),
              std::string::npos);
    const auto landmarks = html.substr(0, html.find("<h2>The most doubtful pairings"));
    EXPECT_EQ(count(landmarks, "alt=\"patch of landmark"), 6U);
}

TEST(CReport, ShowsTheMostDoubtfulPairingsWithBothPatches) {
    auto run = test::hallwayRun();
    auto& rows = run.record.associations;
    const auto made = std::find_if(rows.begin(), rows.end(), [](const auto& row) {
        return row.decision == slam::EDecision::paired && row.landmark == 18;
    });
    ASSERT_NE(made, rows.end());
    made->logRatio = -2;
    made->patch = run.record.landmarks[18].patch;
    run.record.candidates = {{made->time, made->observation, 19, 3.5, -2.25, false}};
    const std::string html = reportOf({run.record, {}});
    const auto table = html.substr(html.find("<h2>The most doubtful pairings"));
    EXPECT_EQ(count(table, "alt=\"patch as seen"), 1U);
    EXPECT_NE(table.find("<td>18</td><td>1.5</td><td>-2.0</td><td>1.2</td><td>19</td>"),
              std::string::npos);
    EXPECT_NE(table.find("alt=\"patch of landmark 19\""), std::string::npos);
    EXPECT_EQ(nestingProblem(html), "");
}

TEST(CReport, ComparesWithTheTruthWhereThereIsOne) {
    const auto run = test::hallwayRun();
    EXPECT_NE(reportOf({run.record, run.truth}).find("ATE RMSE"), std::string::npos);
    EXPECT_EQ(reportOf({run.record, {}}).find("ATE RMSE"), std::string::npos);
    const TTrajectory elsewhere{{1, {}}, {2, {}}};
    EXPECT_NE(reportOf({run.record, elsewhere}).find("Not compared: 0 of"), std::string::npos);
}

TEST(CReport, IsWholeForAnEmptyRunAndRefusesAMissingFigure) {
    const slam::TRunRecord record;
    EXPECT_EQ(nestingProblem(reportOf({record, {}})), "");
    EXPECT_THROW(CReport({record, {}}).html({"no-such.png", "no-such.png"}), std::runtime_error);
}

}  // namespace
}  // namespace salma::viz
