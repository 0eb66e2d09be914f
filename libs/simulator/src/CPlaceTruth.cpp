// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/wrap2pi.h>
#include <salma/simulator/CPlaceTruth.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace salma::simulator {

using laser::EPlaceClass;
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

namespace {

constexpr double kGrid = 0.1;  // in which the plan is walked [m]
constexpr double kReach = 14;  // how far ahead [m]
constexpr double kBack = 3.5;  // and behind [m]

/// A side way.
struct TMouth {
    double from, to;  //!< Along the corridor, from the robot [m].
    bool left;
};

/// A corridor seen from the robot along one of the building's axes.
struct TOutlook {
    std::vector<TMouth> mouths;  //!< Not yet passed, nearest first.
    double end;                  //!< Where the corridor itself is closed, or kReach [m].
};

struct TFrame {
    TPoint2D origin, ahead, left;
    TPoint2D at(double t, double l) const { return origin + ahead * t + left * l; }
};

/// Distances to the sides of an area.
struct TSides {
    double ahead, left, right;
};

double toSide(const TArea& a, const TPoint2D& p, const TPoint2D& direction) {
    if (std::abs(direction.x) > 0.5) return direction.x > 0 ? a.x1 - p.x : p.x - a.x0;
    return direction.y > 0 ? a.y1 - p.y : p.y - a.y0;
}

TSides sidesOf(const TArea& a, const TFrame& frame) {
    return {toSide(a, frame.origin, frame.ahead), toSide(a, frame.origin, frame.left),
            toSide(a, frame.origin, frame.left * -1.0)};
}

TOutlook lookAlong(const CBuilding& building,
                   const TArea& corridor,
                   TFrame frame,
                   const TPlaceRules& rules) {
    const TSides sides = sidesOf(corridor, frame);
    const double half = (sides.left + sides.right) / 2;
    frame.origin = frame.at(0, (sides.left - sides.right) / 2);
    TOutlook outlook{{}, kReach};
    for (double t = 0; t < kReach; t += kGrid)
        if (!building.inCorridor(frame.at(t, 0))) {
            outlook.end = t;
            break;
        }
    for (const bool left : {true, false}) {
        const auto isBranch = [&](double t) {
            for (double l = half + kGrid; l < half + rules.branchDepth; l += kGrid)
                if (!building.inCorridor(frame.at(t, left ? l : -l))) return false;
            return true;
        };
        for (double t = -kBack; t < outlook.end; t += kGrid) {
            if (!isBranch(t)) continue;
            const double from = t;
            while (t < outlook.end && isBranch(t)) t += kGrid;
            if (t > -rules.behind) outlook.mouths.push_back({from, t, left});
        }
    }
    std::sort(outlook.mouths.begin(), outlook.mouths.end(),
              [](const TMouth& a, const TMouth& b) { return a.from < b.from; });
    return outlook;
}

/// The next junction or end ahead: how far, and what it is if it is one of the classes.
struct TNext {
    double distance;
    std::optional<EPlaceClass> place;
};

TNext nextOf(const TOutlook& outlook, const TPlaceRules& rules) {
    if (outlook.mouths.empty()) return {outlook.end, EPlaceClass::deadEnd};
    const TMouth& first = outlook.mouths.front();
    bool left = false, right = false;
    double to = first.to, next = std::numeric_limits<double>::infinity();
    for (const TMouth& mouth : outlook.mouths) {
        if (mouth.from < first.from + 0.6 && !(mouth.left ? left : right)) {
            (mouth.left ? left : right) = true;
            to = std::max(to, mouth.to);
        } else {
            next = std::min(next, mouth.from);
        }
    }
    TNext result{first.from, std::nullopt};
    const double more = outlook.end - to;
    const bool ends = more <= rules.flush, goesOn = more >= rules.branchDepth;
    if (next < to + rules.apart) return result;
    if (left && right) {
        if (ends) result.place = EPlaceClass::teeAhead;
    } else if (ends) {
        result.place = left ? EPlaceClass::bendLeft : EPlaceClass::bendRight;
    } else if (goesOn) {
        result.place = left ? EPlaceClass::teeLeft : EPlaceClass::teeRight;
    }
    return result;
}

TPlaceTruth clear(EPlaceClass place) { return {place, {}, EPlaceDoubt::none}; }
TPlaceTruth unclear(EPlaceDoubt doubt) { return {std::nullopt, {}, doubt}; }

TPlaceTruth inCorridor(const CBuilding& building,
                       const TArea& corridor,
                       const TFrame& frame,
                       const TPlaceRules& rules) {
    const TOutlook outlook = lookAlong(building, corridor, frame, rules);
    if (!outlook.mouths.empty() && outlook.mouths.front().from < rules.minBefore)
        return unclear(EPlaceDoubt::inside);
    const TNext next = nextOf(outlook, rules);
    if (next.distance > rules.far) return clear(EPlaceClass::corridor);
    if (!next.place) return unclear(EPlaceDoubt::compound);
    if (next.distance <= rules.near) return clear(*next.place);
    return {std::nullopt, {EPlaceClass::corridor, *next.place}, EPlaceDoubt::approach};
}

TPlaceTruth inRoom(const TArea& room, const TFrame& frame, const TPlaceRules& rules) {
    const TSides s = sidesOf(room, frame);
    const double side = std::min(s.left, s.right), other = std::max(s.left, s.right);
    const bool inCorner =
        side <= rules.cornerSide && other >= side + rules.cornerOther && other >= rules.cornerAhead;
    const EPlaceClass corner =
        s.left < s.right ? EPlaceClass::cornerLeft : EPlaceClass::cornerRight;
    if (s.ahead >= rules.openAhead) return clear(EPlaceClass::open);
    if (!inCorner) return unclear(EPlaceDoubt::facing);
    if (s.ahead <= rules.cornerAhead) return clear(corner);
    return {std::nullopt, {corner, EPlaceClass::open}, EPlaceDoubt::approach};
}

}  // namespace

const char* asString(EPlaceDoubt doubt) {
    constexpr std::array<const char*, kPlaceDoubts> names{
        "none",          "approach", "inside a junction", "compound junction", "across",
        "facing a wall", "doorway"};
    return names[static_cast<std::size_t>(doubt)];
}

TPlaceTruth placeAt(const CBuilding& building, const TPose2D& pose, const TPlaceRules& rules) {
    const double axis = std::round(pose.phi / (M_PI / 2)) * (M_PI / 2);
    const TPoint2D ahead(std::round(std::cos(axis)), std::round(std::sin(axis)));
    const TFrame frame{{pose.x, pose.y}, ahead, {-ahead.y, ahead.x}};
    if (std::abs(mrpt::math::wrapToPi(pose.phi - axis)) > rules.maxTurn)
        return unclear(EPlaceDoubt::across);
    bool anyCorridor = false;
    for (const TCorridor& c : building.corridors()) {
        if (!c.area.contains(pose.x, pose.y)) continue;
        anyCorridor = true;
        if (c.alongX == (std::abs(ahead.x) > 0.5))
            return inCorridor(building, c.area, frame, rules);
    }
    if (anyCorridor) return unclear(EPlaceDoubt::across);
    for (const TArea& room : building.rooms())
        if (room.contains(pose.x, pose.y)) return inRoom(room, frame, rules);
    return unclear(EPlaceDoubt::doorway);
}

}  // namespace salma::simulator
