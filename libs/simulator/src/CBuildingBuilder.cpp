// SPDX-License-Identifier: BSD-3-Clause
#include "CBuildingBuilder.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace salma::simulator {

using mrpt::math::TPoint2D;

namespace {

constexpr int kAttempts = 400;          // to find a place for a corridor
constexpr double kApart = 1.2;          // corridors that do not meet keep this distance [m]
constexpr double kWall = 0.15;          // between a corridor and its rooms [m]
constexpr double kRecess = 0.08;        // a shut door stands back so far [m]
constexpr double kEndMargin = 0.9;      // robots turn this far before a dead end [m]
constexpr double kRoomMargin = 1.1;     // the same in the corner of a room [m]
constexpr double kBranchMargin = 2.5;   // a T keeps this distance from its parent's ends [m]
constexpr double kWayHalfWidth = 0.45;  // nothing stands this near to a way [m]
constexpr std::size_t kNone = static_cast<std::size_t>(-1);

double start(const TCorridor& c) { return c.alongX ? c.area.x0 : c.area.y0; }
double end(const TCorridor& c) { return c.alongX ? c.area.x1 : c.area.y1; }
double low(const TCorridor& c) { return c.alongX ? c.area.y0 : c.area.x0; }
double high(const TCorridor& c) { return c.alongX ? c.area.y1 : c.area.x1; }
double middle(const TCorridor& c) { return (low(c) + high(c)) / 2; }

/// From coordinates along and across a corridor.
TArea areaOf(bool alongX, double from, double to, double lowSide, double highSide) {
    if (alongX) return {from, lowSide, to, highSide};
    return {lowSide, from, highSide, to};
}
TPoint2D pointOf(bool alongX, double along, double across) {
    return alongX ? TPoint2D(along, across) : TPoint2D(across, along);
}

TArea grown(const TArea& a, double by) { return {a.x0 - by, a.y0 - by, a.x1 + by, a.y1 + by}; }

double distanceToSegment(const TPoint2D& p, const TPoint2D& a, const TPoint2D& b) {
    const TPoint2D e = b - a;
    const double length2 = e.x * e.x + e.y * e.y;
    double t = length2 > 0 ? ((p.x - a.x) * e.x + (p.y - a.y) * e.y) / length2 : 0;
    t = std::clamp(t, 0.0, 1.0);
    return std::hypot(p.x - a.x - t * e.x, p.y - a.y - t * e.y);
}

}  // namespace

CBuildingBuilder::CBuildingBuilder(const TBuildingOptions& options,
                                   std::uint32_t seed,
                                   CBuilding& building)
    : m_options(options), m_random(seed, "building", 0), m_building(building) {}

void CBuildingBuilder::build() {
    addCorridors();
    addRooms();
    addStations();
    addWalls();
    addClutter();
}

bool CBuildingBuilder::fits(const TArea& area, double margin, std::size_t except) const {
    const TArea wide = grown(area, margin);
    for (std::size_t i = 0; i < m_building.m_corridors.size(); ++i)
        if (i != except && wide.overlaps(m_building.m_corridors[i].area)) return false;
    for (const TArea& room : m_building.m_rooms)
        if (wide.overlaps(room)) return false;
    return true;
}

void CBuildingBuilder::addCorridors() {
    const double width = draw(m_options.corridorWidth);
    m_building.m_corridors.push_back(
        {{0, -width / 2, 1.5 * draw(m_options.corridorLength), width / 2}, true});
    m_branches.push_back({kNone, 0, false, false});
    for (int i = 0; i < kAttempts; ++i)
        if (m_building.m_corridors.size() < static_cast<std::size_t>(m_options.corridors))
            addBranch();
}

void CBuildingBuilder::addBranch() {
    const std::size_t parent = pick(m_building.m_corridors.size());
    const TCorridor p = m_building.m_corridors[parent];
    const double width = draw(m_options.corridorWidth), length = draw(m_options.corridorLength);
    const bool highSide = chance(0.5), atSide = chance(0.5), atStart = chance(0.5);
    double from = atStart ? start(p) : end(p) - width;
    if (atSide) {
        const double last = end(p) - width - kBranchMargin;
        if (!(last > start(p) + kBranchMargin)) return;
        from = m_random.uniform(start(p) + kBranchMargin, last);
    } else if (const std::size_t before = m_branches[parent].parent; before != kNone) {
        // the end where the parent itself begins is taken
        const bool beginsAtStart = middle(m_building.m_corridors[before]) < start(p);
        if (atStart == beginsAtStart) return;
    }
    // exactly at the parent's side: a gap of a rounding error would be a wall
    const TArea area = highSide ? areaOf(p.alongX, from, from + width, high(p), high(p) + length)
                                : areaOf(p.alongX, from, from + width, low(p) - length, low(p));
    if (!fits(area, kApart, parent)) return;
    m_building.m_corridors.push_back({area, !p.alongX});
    m_branches.push_back({parent, from + width / 2, !atSide && atStart, !atSide && !atStart});
}

void CBuildingBuilder::addRooms() {
    for (std::size_t c = 0; c < m_building.m_corridors.size(); ++c)
        for (const bool highSide : {false, true}) {
            const TCorridor& corridor = m_building.m_corridors[c];
            for (double at = start(corridor) + m_random.uniform(0.1, 3); at < end(corridor);
                 at += m_random.uniform(0.5, 3))
                addRoom(c, highSide, at);
        }
}

void CBuildingBuilder::addRoom(std::size_t c, bool highSide, double from) {
    const TCorridor& corridor = m_building.m_corridors[c];
    const double width = draw(m_options.roomSize), depth = draw(m_options.roomSize);
    const double doorWidth = draw(m_options.doorWidth);
    const double doorAt = from + m_random.uniform(0.4, width - doorWidth - 0.4);
    const bool isOpen = chance(m_options.openShare);
    if (!(doorAt + doorWidth < end(corridor) - 0.3 && doorAt > start(corridor) + 0.3)) return;
    const double side = highSide ? high(corridor) : low(corridor);
    const double near = highSide ? side + kWall : side - kWall;
    const double far = highSide ? near + depth : near - depth;
    const TArea room =
        areaOf(corridor.alongX, from, from + width, std::min(near, far), std::max(near, far));
    if (!fits(room, 0.6 * kWall, kNone)) return;
    const double back = isOpen ? near : (highSide ? side + kRecess : side - kRecess);
    const TArea passage = areaOf(corridor.alongX, doorAt, doorAt + doorWidth, std::min(side, back),
                                 std::max(side, back));
    m_building.m_doorways.push_back({passage, isOpen, c, m_building.m_rooms.size()});
    m_building.m_rooms.push_back(room);
}

std::size_t CBuildingBuilder::station(const TPoint2D& at) {
    auto& all = m_building.m_stations;
    for (std::size_t i = 0; i < all.size(); ++i)
        if ((all[i].at - at).norm() < 1e-6) return i;
    all.push_back({at, {}});
    return all.size() - 1;
}

void CBuildingBuilder::join(std::size_t a, std::size_t b) {
    if (a == b) return;
    m_building.m_stations[a].next.push_back(b);
    m_building.m_stations[b].next.push_back(a);
}

void CBuildingBuilder::addStations() {
    for (std::size_t c = 0; c < m_building.m_corridors.size(); ++c) joinCorridor(c);
}

void CBuildingBuilder::joinCorridor(std::size_t c) {
    const TCorridor& corridor = m_building.m_corridors[c];
    std::vector<double> along;
    bool endsAtStart = true, endsAtEnd = true;
    const TBranch& own = m_branches[c];
    if (own.parent != kNone) {
        const double parentAxis = middle(m_building.m_corridors[own.parent]);
        along.push_back(parentAxis);
        (parentAxis < start(corridor) ? endsAtStart : endsAtEnd) = false;
    }
    for (std::size_t child = 0; child < m_branches.size(); ++child)
        if (m_branches[child].parent == c) {
            along.push_back(m_branches[child].at);
            if (m_branches[child].atStart) endsAtStart = false;
            if (m_branches[child].atEnd) endsAtEnd = false;
        }
    std::vector<std::pair<double, const TDoorway*>> doors;
    for (const TDoorway& door : m_building.m_doorways)
        if (door.corridor == c && door.open) {
            const TArea& a = door.area;
            const double at = corridor.alongX ? (a.x0 + a.x1) / 2 : (a.y0 + a.y1) / 2;
            doors.emplace_back(at, &door);
            along.push_back(at);
        }
    if (endsAtStart) along.push_back(start(corridor) + kEndMargin);
    if (endsAtEnd) along.push_back(end(corridor) - kEndMargin);
    std::sort(along.begin(), along.end());
    std::size_t previous = kNone;
    for (const double at : along) {
        const std::size_t next = station(pointOf(corridor.alongX, at, middle(corridor)));
        if (previous != kNone) join(previous, next);
        previous = next;
    }
    for (const auto& [at, door] : doors)
        joinRoom(*door, station(pointOf(corridor.alongX, at, middle(corridor))));
}

void CBuildingBuilder::joinRoom(const TDoorway& door, std::size_t onAxis) {
    const TArea& room = m_building.m_rooms[door.room];
    const bool alongX = m_building.m_corridors[door.corridor].alongX;
    const TPoint2D entry = m_building.m_stations[onAxis].at;
    const double at = alongX ? entry.x : entry.y;
    const double from = alongX ? room.x0 : room.y0, to = alongX ? room.x1 : room.y1;
    const double near = alongX ? room.y0 : room.x0, far = alongX ? room.y1 : room.x1;
    const double depth = (near + far) / 2;
    const bool highSide = (alongX ? entry.y : entry.x) < depth;
    const double back = highSide ? far - kRoomMargin : near + kRoomMargin;
    const std::size_t hub = station(pointOf(alongX, at, depth));
    join(onAxis, hub);
    for (const double side : {from + kRoomMargin, to - kRoomMargin}) {
        const std::size_t middleOfSide = station(pointOf(alongX, side, depth));
        join(hub, middleOfSide);
        join(middleOfSide, station(pointOf(alongX, side, back)));
    }
}

void CBuildingBuilder::addWalls() {
    std::vector<TArea> areas = m_building.m_rooms;
    for (const auto& c : m_building.m_corridors) areas.push_back(c.area);
    for (const auto& d : m_building.m_doorways) areas.push_back(d.area);
    std::vector<double> xs, ys;
    for (const TArea& a : areas) {
        xs.insert(xs.end(), {a.x0, a.x1});
        ys.insert(ys.end(), {a.y0, a.y1});
    }
    for (auto* edges : {&xs, &ys}) {
        std::sort(edges->begin(), edges->end());
        edges->erase(std::unique(edges->begin(), edges->end()), edges->end());
    }
    const std::size_t nx = xs.size() - 1, ny = ys.size() - 1;
    std::vector<char> inside(nx * ny, 0);
    for (const TArea& a : areas) {
        const auto column = [&](double x) {
            return static_cast<std::size_t>(std::lower_bound(xs.begin(), xs.end(), x) - xs.begin());
        };
        const auto row = [&](double y) {
            return static_cast<std::size_t>(std::lower_bound(ys.begin(), ys.end(), y) - ys.begin());
        };
        for (std::size_t i = column(a.x0); i < column(a.x1); ++i)
            for (std::size_t j = row(a.y0); j < row(a.y1); ++j) inside[i * ny + j] = 1;
    }
    const auto cell = [&](std::size_t i, std::size_t j) {
        return i < nx && j < ny && inside[i * ny + j] != 0;  // i - 1 of 0 is large
    };
    // walls are where inside and outside meet; runs of them are one wall
    const auto addRuns = [&](std::size_t lines, std::size_t count, const auto& isWall,
                             const auto& at) {
        for (std::size_t i = 0; i < lines; ++i)
            for (std::size_t j = 0; j < count; ++j) {
                if (!isWall(i, j)) continue;
                const std::size_t first = j;
                while (j < count && isWall(i, j)) ++j;
                m_building.m_segments.push_back({at(i, first), at(i, j)});
            }
    };
    addRuns(
        nx + 1, ny, [&](auto i, auto j) { return cell(i, j) != cell(i - 1, j); },
        [&](auto i, auto j) { return TPoint2D(xs[i], ys[j]); });
    addRuns(
        ny + 1, nx, [&](auto j, auto i) { return cell(i, j) != cell(i, j - 1); },
        [&](auto j, auto i) { return TPoint2D(xs[i], ys[j]); });
}

bool CBuildingBuilder::clearOfWays(const std::vector<TPoint2D>& outline, double distance) const {
    constexpr double kStep = 0.1;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const TPoint2D a = outline[i], b = outline[(i + 1) % outline.size()];
        const double steps = std::ceil((b - a).norm() / kStep);
        for (double k = 0; k < steps; ++k)
            for (const TStation& s : m_building.m_stations)
                for (const std::size_t next : s.next)
                    if (distanceToSegment(a + (b - a) * (k / steps), s.at,
                                          m_building.m_stations[next].at) < distance)
                        return false;
    }
    return true;
}

void CBuildingBuilder::addOutline(const std::vector<TPoint2D>& outline) {
    for (std::size_t i = 0; i < outline.size(); ++i)
        m_building.m_segments.push_back({outline[i], outline[(i + 1) % outline.size()]});
}

void CBuildingBuilder::addClutter() {
    for (const auto& corridor : m_building.m_corridors) {
        const double length = end(corridor) - start(corridor);
        for (double at = 0; at < length; at += 1)
            if (chance(m_options.clutterPerMetre))
                addBoxAtWall(corridor.area, corridor.alongX,
                             (high(corridor) - low(corridor)) / 2 - kWayHalfWidth);
    }
    for (const TArea& room : m_building.m_rooms) {
        const std::size_t count = pick(static_cast<std::size_t>(m_options.clutterPerRoom) + 1);
        for (std::size_t i = 0; i < count; ++i) {
            if (chance(0.6))
                addBoxAtWall(room, chance(0.5), 0.9);
            else
                addLooseBox(room);
        }
    }
}

void CBuildingBuilder::addBoxAtWall(const TArea& area, bool alongX, double maxDepth) {
    const TCorridor strip{area, alongX};
    const double length = m_random.uniform(0.3, 1.2), depth = m_random.uniform(0.1, maxDepth);
    const double from = m_random.uniform(start(strip), end(strip) - length);
    const bool highSide = chance(0.5);
    const double wall = highSide ? high(strip) : low(strip);
    const double front = highSide ? wall - depth : wall + depth;
    const double behind = highSide ? wall + 0.02 : wall - 0.02;
    const auto isFree = [&](const TPoint2D& p) {
        if (m_building.inCorridor(p)) return true;
        const auto holds = [&](const TArea& a) { return a.contains(p.x, p.y); };
        return std::any_of(m_building.m_rooms.begin(), m_building.m_rooms.end(), holds) ||
               std::any_of(m_building.m_doorways.begin(), m_building.m_doorways.end(),
                           [&](const TDoorway& d) { return holds(d.area); });
    };
    for (double along = from; along <= from + length; along += length / 8)
        if (isFree(pointOf(alongX, along, behind))) return;  // nothing stands in a mouth or a door
    const std::vector<TPoint2D> outline{pointOf(alongX, from, wall), pointOf(alongX, from, front),
                                        pointOf(alongX, from + length, front),
                                        pointOf(alongX, from + length, wall)};
    if (clearOfWays(outline, kWayHalfWidth)) addOutline(outline);
}

void CBuildingBuilder::addLooseBox(const TArea& room) {
    const double a = m_random.uniform(0.3, 1.2) / 2, b = m_random.uniform(0.3, 0.8) / 2;
    const double x = m_random.uniform(room.x0 + 0.8, room.x1 - 0.8);
    const double y = m_random.uniform(room.y0 + 0.8, room.y1 - 0.8);
    const double turn = m_random.uniform(0, M_PI);
    std::vector<TPoint2D> outline;
    for (const auto& [u, v] :
         std::array<std::pair<double, double>, 4>{{{a, b}, {-a, b}, {-a, -b}, {a, -b}}})
        outline.emplace_back(x + u * std::cos(turn) - v * std::sin(turn),
                             y + u * std::sin(turn) + v * std::cos(turn));
    if (clearOfWays(outline, kWayHalfWidth)) addOutline(outline);
}

}  // namespace salma::simulator
