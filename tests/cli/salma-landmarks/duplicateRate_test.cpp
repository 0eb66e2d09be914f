// SPDX-License-Identifier: BSD-3-Clause
#include <duplicateRate.h>
#include <gtest/gtest.h>

#include <cmath>

namespace salma::apps {
namespace {

/// `places` posters, each seen `views` times; the pictures of the first two are `second` and "p0".
struct TScene {
    TScene(int places, int views, const std::string& second) {
        for (int view = 0; view < views; ++view)
            for (int p = 0; p < places; ++p) {
                TSeenPoster seen;
                seen.poster = p;
                seen.texture = p == 1 ? second : "p" + std::to_string(p);
                run.seen.push_back(seen);
            }
        for (std::size_t a = 0; a < run.seen.size(); ++a)
            for (std::size_t b = a + 1; b < run.seen.size(); ++b) {
                const auto &first = run.seen[a], &other = run.seen[b];
                TLabelledPair pair;
                pair.kind = first.poster == other.poster     ? EPair::same
                            : first.texture == other.texture ? EPair::duplicate
                                                             : EPair::other;
                pair.a = a;
                pair.b = b;
                pair.textureA = first.texture;
                pair.textureB = other.texture;
                pair.evidence = appearance::EEvidence::both;
                pairs.push_back(pair);
            }
    }
    TDuplicateRate rate(double ofDuplicates, double ofOthers) const {
        return duplicateRate({run}, {pairs}, [&](const TLabelledPair& pair) {
            return pair.kind == EPair::duplicate ? ofDuplicates : ofOthers;
        });
    }
    TLabelledRun run;
    std::vector<TLabelledPair> pairs;
};

TEST(DuplicateRate, IsThePriorAloneWhereNothingLooksTheSame) {
    const auto found = TScene(5, 3, "p1").rate(1, 1e-9);
    EXPECT_EQ(found.posterPairs, 10U);
    EXPECT_EQ(found.prints, 0U);
    EXPECT_NEAR(found.rate, 0.5 / 11, 1e-6);
}

TEST(DuplicateRate, CountsASureDuplicateAsOne) {
    const auto found = TScene(5, 3, "p0").rate(1e9, 1e-9);
    EXPECT_EQ(found.prints, 1U);
    EXPECT_NEAR(found.rate, 1.5 / 11, 1e-6);
}

TEST(DuplicateRate, SolvesTheEquationOfTheMixture) {
    const double pi = TScene(6, 2, "p0").rate(20, 0.1).rate;
    const auto share = [&](double lr) { return pi * lr / (1 - pi + pi * lr); };
    EXPECT_NEAR(pi * 16, 0.5 + share(20) + 14 * share(0.1), 1e-6);
}

TEST(DuplicateRate, DoesNotDependOnHowOftenPlacesWereSeen) {
    EXPECT_NEAR(TScene(5, 2, "p0").rate(50, 0.05).rate, TScene(5, 7, "p0").rate(50, 0.05).rate,
                1e-6);
    const TScene scene(5, 2, "p0");  // two runs of one world
    const auto twice = duplicateRate({scene.run, scene.run}, {scene.pairs, scene.pairs},
                                     [](const TLabelledPair&) { return 1.0; });
    EXPECT_EQ(twice.posterPairs, 10U);
}

}  // namespace
}  // namespace salma::apps
