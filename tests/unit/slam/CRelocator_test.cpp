// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/slam/CRelocator.h>

#include <cmath>
#include <memory>

namespace salma::slam {
namespace {

constexpr double kDrift = 10;  // sigma of where the local map lies [m]

double ratio(const observations::TPatch& a, const observations::TPatch& b) {
    return a.width == b.width ? 8 : -3;
}

/// Two pictures on one wall, driven past in the places that are named, one after the other.
class CTwoPictures {
 public:
    /// \param views Where the sensors looked then. \param third One more picture between both.
    /// \param mark What tells these pictures from others.
    void passAt(
        double y, bool local, const TViews& views = {}, bool third = false, double mark = 1.5) {
        TPastStep step;
        static_cast<TViews&>(step) = views;
        step.increment = {m_history.empty() ? 0.0 : apart, 0, 0};
        step.Q.diagonal() << kDrift * kDrift, kDrift * kDrift, 0.01;
        step.pose = {10, y, 0};
        for (const double side : {-1.0, 1.0}) see({10 + side, y + 1}, mark + side, local, step);
        if (third) see({10, y + 1}, thirdMark, local, step);
        m_history.add(step);
        m_pose = step.pose;
    }

    double apart{40};       //!< Travel between two passes [m].
    double thirdMark{1.5};  //!< What tells the third picture from others.

 private:
    template <class QUESTION>
    auto ask(QUESTION question, const TRelocationOptions& options) {
        const auto size = static_cast<Eigen::Index>(3 + 2 * m_places.size());
        Eigen::VectorXd mean(size);
        mean.head<3>() = m_pose;
        RowMatrix covariance = 1e-3 * RowMatrix::Identity(size, size);
        Eigen::MatrixXd drift = Eigen::MatrixXd::Zero(size, 2);  // moves robot and local map alike
        drift.topRows<2>().setIdentity();
        for (std::size_t i = 0; i < m_places.size(); ++i) {
            const auto row = static_cast<Eigen::Index>(3 + 2 * i);
            mean.segment<2>(row) = m_places[i];
            if (m_local[i]) drift.middleRows<2>(row).setIdentity();
        }
        covariance += kDrift * kDrift * drift * drift.transpose();
        const PatchRatio compare = ratio;
        CRelocator relocator(options);
        return question(relocator, {m_landmarks, mean, covariance, m_history, compare});
    }

 public:
    TRelocation relocated(const TRelocationOptions& options = {}) {
        return ask([](CRelocator& r, const TRelocationInput& input) { return r.find(input); },
                   options);
    }

    /// An alignment judged by everything, with both maps as they lie.
    TAlignment extended(const TAlignment& alignment, const TRelocationOptions& options) {
        return ask([&](CRelocator& r,
                       const TRelocationInput& input) { return r.extended(input, alignment); },
                   options);
    }

 private:
    void see(const Eigen::Vector2d& place, double mark, bool local, TPastStep& step) {
        association::TMeasurement seen;
        seen.kind = association::ELandmarkKind::salient;
        const Eigen::Vector2d away = place - step.pose.head<2>();
        seen.z = {away.norm(), std::atan2(away.y(), away.x())};
        seen.R = Eigen::Vector2d(1e-3, 1e-4).asDiagonal();
        seen.wallAngle = -M_PI / 2;
        seen.wallAngleSigma = 0.02;
        auto patch = std::make_shared<observations::TPatch>();
        patch->width = mark;
        seen.patch = patch;
        const int id = m_landmarks.add(seen, 0);
        m_landmarks.sight(m_places.size(), seen, 0, {0, 0.01});
        step.used.push_back({id, seen.z, seen.R});
        m_places.push_back(place);
        m_local.push_back(local);
    }

    CLandmarkTable m_landmarks{4, 0.2};
    CPathHistory m_history;
    std::vector<Eigen::Vector2d> m_places;
    std::vector<bool> m_local;
    Eigen::Vector3d m_pose{0, 0, 0};
};

TEST(CRelocator, FindsThePlaceThatHasBothPictures) {
    CTwoPictures world;
    world.passAt(0, false);
    world.passAt(8, true);
    const TRelocation found = world.relocated();
    EXPECT_EQ(found.outcome, ERelocation::found);
    EXPECT_NEAR(found.best.T[1], -8, 0.1);
    EXPECT_EQ(found.best.matchedPosters(), 2u);
}

TEST(CRelocator, DoesNotChooseBetweenTwoPlacesAlike) {
    CTwoPictures world;
    world.passAt(0, false);
    world.passAt(16, false);
    world.passAt(8, true);
    EXPECT_FALSE(CRelocator().proves(world.relocated().best)) << "look-alikes say little";
    TRelocationOptions options;
    options.accept = -100;  // the margin alone
    const TRelocation doubtful = world.relocated(options);
    EXPECT_EQ(doubtful.outcome, ERelocation::ambiguous);
    EXPECT_LT(doubtful.margin, options.margin);
    options.margin = 0;
    EXPECT_EQ(world.relocated(options).outcome, ERelocation::found) << "nothing else is in the way";
}

TEST(CRelocator, CountsThePictureThatShouldHaveBeenSeenUnlessSomethingHidesIt) {
    const auto scored = [](const TViews& views) {
        CTwoPictures world;
        world.passAt(0, false, {}, true);
        world.passAt(8, true, views);
        const TRelocation found = world.relocated();
        EXPECT_EQ(found.best.matchedPosters(), 2u);
        return found.best.posters;
    };
    TViews views;
    const double nobodyLooked = scored(views);
    views.camera = TCameraView{{0, 0, M_PI_2}, 1.2};
    // 1 m straight ahead; the tables say how often that is found. What was seen once is there with
    // 60 %, and in another place something would hang there, too, with 50 %.
    const double found = 0.6 * TDetectionOptions().probability(0, 1);
    const double missed = std::log((1 - found) / (1 - 0.5 * found));
    EXPECT_NEAR(scored(views) - nobodyLooked, missed, 1e-6);
    views.laser.emplace();
    views.laser->sensor[2] = M_PI_2;
    views.laser->first = -M_PI_2;
    views.laser->spacing = M_PI / 180;
    views.laser->free = std::make_shared<std::vector<float>>(181, 0.2F);
    EXPECT_EQ(scored(views), nobodyLooked);
    views.laser->free = std::make_shared<std::vector<float>>(181, 5.0F);
    EXPECT_NEAR(scored(views) - nobodyLooked, missed, 1e-6);
}

TEST(CRelocator, TakesPrintsForSigns) {
    CTwoPictures world;
    world.passAt(0, false);
    world.passAt(16, false);  // the same two pictures again
    world.passAt(8, true);
    const TAlignment signs = world.relocated().best;
    EXPECT_EQ(signs.matchedPosters(), 2u);
    EXPECT_EQ(signs.posters, 0);
    EXPECT_GT(signs.signs, 0);
    CTwoPictures single;
    single.passAt(0, false);
    single.passAt(8, true);
    EXPECT_EQ(single.relocated().best.signs, 0);
    EXPECT_GT(single.relocated().best.posters, 5);
}

TEST(CRelocator, NearnessProvesNothing) {
    TAlignment alignment;
    alignment.posters = 4;
    alignment.corners = 20;
    alignment.signs = 3;
    EXPECT_EQ(alignment.score(2), 6);
    alignment.odometry = 9;
    EXPECT_EQ(alignment.score(2), 6);
    EXPECT_EQ(alignment.total(), 36);
    alignment.odometry = -3;
    EXPECT_EQ(alignment.score(2), 3);
}

TEST(CRelocator, AsksForTheScore) {
    CTwoPictures world;
    world.passAt(0, false);
    world.passAt(8, true);
    TRelocationOptions strict;
    strict.propose = 1000;
    EXPECT_EQ(world.relocated(strict).outcome, ERelocation::unproved);
    strict.accept = 1000;
    const TAlignment best = world.relocated().best;
    EXPECT_FALSE(CRelocator(strict).proves(best));
    EXPECT_TRUE(CRelocator().proves(best));
}

TEST(CRelocator, JudgesEachPassOnItsOwn) {
    const auto posters = [](bool anotherFloor) {
        CTwoPictures world;
        world.passAt(0, false);
        // Other pictures in the same place, one of them a print: the floor above, drawn onto the
        // one below.
        if (anotherFloor) world.passAt(0.1, false, {}, true, 7);
        world.passAt(8, true, {}, anotherFloor);
        const TAlignment best = world.relocated().best;
        EXPECT_EQ(best.matchedPosters(), 2u);
        EXPECT_LT(best.leftTo, 60) << "the second pass is 80 m from the start";
        return best.posters;
    };
    EXPECT_NEAR(posters(true), posters(false), 0.1);
}

TEST(CRelocator, AsksWhatWasSeenBeforeTheLocalMap) {
    const auto judged = [](double mark) {
        TRelocationOptions options;
        options.localTravel = 5;  // only the last pass
        CTwoPictures world;
        world.apart = 12;
        world.passAt(0, false);
        world.passAt(20, false, {}, false, 7);
        world.passAt(0, true, {}, false, mark);
        world.passAt(20, true, {}, false, 7);
        const TAlignment local = world.relocated(options).best;
        EXPECT_EQ(local.matchedPosters(), 2u);
        return world.extended(local, options);
    };
    const TAlignment confirmed = judged(1.5), contradicted = judged(12);
    EXPECT_EQ(confirmed.matchedPosters(), 4u);
    EXPECT_EQ(contradicted.matchedPosters(), 2u);
    EXPECT_TRUE(CRelocator().proves(confirmed));
    EXPECT_GT(confirmed.posters, contradicted.posters + 6);
}

}  // namespace
}  // namespace salma::slam
