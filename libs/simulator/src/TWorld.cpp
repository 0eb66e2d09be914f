// SPDX-License-Identifier: BSD-3-Clause
#include <salma/config/CStrictFile.h>
#include <salma/simulator/CPath.h>
#include <salma/simulator/TWorld.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "textures.h"

namespace salma::simulator {

using config::COptionVisitor;
using config::CStrictSection;
using Ini = mrpt::config::CConfigFileBase;

void TRoomOptions::visit(COptionVisitor& v) {
    v.number("ceiling_m", ceilingHeight, config::between(1, 20), "height of the ceiling");
    v.text("floor", floor, "built-in name or picture file");
    v.text("ceiling", ceiling, "built-in name or picture file");
}

void TPathOptions::visit(COptionVisitor& v) {
    v.numbers("points_m", points, config::anyNumber(), "corners of the path: x y x y ...");
    v.flag("closed", closed, "from the last point back to the first");
    v.integer("laps", laps, config::between(1, 100), "times round");
    v.number("corner_radius_m", cornerRadius, config::between(0.05, 100), "of the arcs");
    v.number("speed_mps", speed, config::between(0.01, 5), "cruising speed");
    v.degrees("turn_rate_deg_s", turnRate, config::between(1, 360), "greatest turn rate");
    v.number("acceleration_mps2", acceleration, config::between(0.01, 10), "greatest");
    v.number("wander_m", wander, config::between(0, 1), "amplitude of swaying to the sides");
    v.numbers("floors", floors, config::between(1, 9),
              "floor of the way from each point to the next; empty: all 1");
}

void TPathOptions::validate() const {
    const auto say = [this](const std::string& problem) {
        throw std::invalid_argument("points_m holds " + std::to_string(points.size()) +
                                    " numbers: " + problem);
    };
    if (points.size() % 2 != 0) say("an x lacks its y");
    if (points.size() < (closed ? 6 : 4)) say("too few points");
    const std::size_t ways = points.size() / 2 - (closed ? 0 : 1);
    if (!floors.empty() && floors.size() != ways)
        throw std::invalid_argument("floors holds " + std::to_string(floors.size()) +
                                    " numbers: the path has " + std::to_string(ways) + " ways");
    for (const double floor : floors)
        if (floor != std::floor(floor))
            throw std::invalid_argument("floors = " + std::to_string(floor) +
                                        " is not a whole number");
    if (!closed && laps > 1)
        throw std::invalid_argument("laps = " + std::to_string(laps) + " needs closed = true");
}

const TWall& TWorld::wall(const std::string& wallName) const {
    for (const auto& w : walls)
        if (w.name == wallName) return w;
    throw std::out_of_range("no wall " + wallName);
}

namespace {

/// Reads the elements of one kind and checks what involves more than one key or section.
class CWorldReader {
 public:
    CWorldReader(const Ini& file, TWorld& world) : m_file(file), m_world(world) {}

    void readAll() {
        config::rejectUnknownSections(
            m_file, {"world", "path", "laser", "camera", "head", "odometry", "people", "wall_*",
                     "door_*", "box_*", "poster_*", "lamp_*"});
        section(m_world.room, "world");
        section(m_world.laser, "laser");
        section(m_world.camera, "camera");
        section(m_world.head, "head");
        section(m_world.odometry, "odometry");
        section(m_world.people, "people");
        elements(m_world.walls, "wall_");
        elements(m_world.doors, "door_");
        elements(m_world.boxes, "box_");
        elements(m_world.posters, "poster_");
        elements(m_world.lamps, "lamp_");
        if (m_world.walls.empty())
            throw std::invalid_argument(config::fileName(m_file) + ": has no [wall_...]");
        readPath();
        checkTexture("world", "floor", m_world.room.floor);
        checkTexture("world", "ceiling", m_world.room.ceiling);
        for (const auto& w : m_world.walls) check(w);
        for (const auto& d : m_world.doors) check(d);
        for (const auto& b : m_world.boxes) check(b);
        for (const auto& p : m_world.posters) check(p);
        for (const auto& l : m_world.lamps)
            if (l.position.size() != 3)
                fail("lamp_" + l.name, "position_m", "must be three numbers: x, y and height");
    }

 private:
    /// Loads one section; what validate() says gets file and section in front.
    template <class OPTIONS>
    void section(OPTIONS& options, const std::string& name) {
        CStrictSection ini(m_file, name);
        options.visit(ini);
        ini.rejectUnknownKeys();
        try {
            options.validate();
        } catch (const std::invalid_argument& e) {
            throw std::invalid_argument(config::fileName(m_file) + ": [" + name + "] " + e.what());
        }
    }

    template <class ELEMENT>
    void elements(std::vector<ELEMENT>& all, const std::string& prefix) {
        std::vector<std::string> sections;
        m_file.getAllSections(sections);
        for (const auto& name : sections) {
            if (name.compare(0, prefix.size(), prefix) != 0) continue;
            ELEMENT element;
            element.name = name.substr(prefix.size());
            section(element, name);
            all.push_back(element);
        }
    }

    [[noreturn]] void fail(const std::string& section,
                           const std::string& key,
                           const std::string& problem) const {
        CStrictSection(m_file, section).fail(key, problem);
    }

    void readPath() {
        section(m_world.path, "path");
        try {
            CPath check(m_world.path);
        } catch (const std::invalid_argument& e) {
            fail("path", "points_m", e.what());
        }
    }

    void checkTexture(const std::string& section,
                      const std::string& key,
                      const std::string& texture) const {
        if (texture.empty()) fail(section, key, "names no texture");
        if (isBuiltInTexture(texture)) return;
        const auto file = m_world.file.parent_path() / texture;
        if (!std::filesystem::is_regular_file(file))
            fail(section, key, "is neither a file beside the world nor a built-in texture");
        if (!cv::haveImageReader(file.string())) fail(section, key, "is not a picture");
    }

    void checkPoint(const std::string& section,
                    const std::string& key,
                    const std::vector<double>& point) const {
        if (point.size() != 2) fail(section, key, "must be two numbers, x and y");
    }

    const TWall& wallOf(const std::string& section, const std::string& wall) const {
        try {
            return m_world.wall(wall);
        } catch (const std::out_of_range&) {
            fail(section, "wall", "is not the name of a [wall_...]");
        }
    }

    void check(const TWall& wall) const {
        const std::string section = "wall_" + wall.name;
        checkPoint(section, "from_m", wall.from);
        checkPoint(section, "to_m", wall.to);
        if (!(wall.length() > 1e-3)) fail(section, "to_m", "leaves the wall without length");
        checkTexture(section, "texture", wall.texture);
    }

    void check(const TDoor& door) const {
        const std::string section = "door_" + door.name;
        const TWall& wall = wallOf(section, door.wall);
        if (door.at.empty()) fail(section, "at_m", "holds no position");
        if (!(door.height < m_world.room.ceilingHeight))
            fail(section, "height_m", "reaches the ceiling");
        std::vector<double> sorted = door.at;
        std::sort(sorted.begin(), sorted.end());
        if (!(sorted.front() - door.width / 2 > 0 &&
              sorted.back() + door.width / 2 < wall.length()))
            fail(section, "at_m", "puts a door outside its wall");
        for (std::size_t i = 1; i < sorted.size(); ++i)
            if (!(sorted[i] - sorted[i - 1] > door.width)) fail(section, "at_m", "overlaps itself");
        for (const auto& other : m_world.doors)
            if (&other != &door && other.wall == door.wall && overlaps(door, other))
                fail(section, "at_m", "overlaps [door_" + other.name + "]");
        checkTexture(section, "texture", door.texture);
    }

    static bool overlaps(const TDoor& a, const TDoor& b) {
        for (const double p : a.at)
            for (const double q : b.at)
                if (!(std::abs(p - q) > (a.width + b.width) / 2)) return true;
        return false;
    }

    void check(const TBox& box) const {
        checkPoint("box_" + box.name, "centre_m", box.centre);
        if (!(box.top <= m_world.room.ceilingHeight))
            fail("box_" + box.name, "top_m", "is above the ceiling");
        checkTexture("box_" + box.name, "texture", box.texture);
    }

    void check(const TPoster& poster) const {
        const std::string section = "poster_" + poster.name;
        checkPlace(poster, poster.at, "at_m");
        if (poster.movedInLap > 0) checkPlace(poster, poster.movedAt, "moved_at_m");
        if (!(poster.centreHeight - poster.height / 2 >= 0 &&
              poster.centreHeight + poster.height / 2 <= m_world.room.ceilingHeight))
            fail(section, "centre_height_m", "puts the poster outside its wall");
        checkTexture(section, "texture", poster.texture);
    }

    /// `place` is the poster's centre along its wall, which `key` states.
    void checkPlace(const TPoster& poster, double place, const std::string& key) const {
        const std::string section = "poster_" + poster.name;
        const TWall& wall = wallOf(section, poster.wall);
        if (!(place - poster.width / 2 >= 0 && place + poster.width / 2 <= wall.length()))
            fail(section, key, "puts the poster outside its wall");
        for (const auto& door : m_world.doors)
            for (const double at : door.at)
                if (door.wall == poster.wall &&
                    std::abs(at - place) < (door.width + poster.width) / 2 &&
                    poster.centreHeight - poster.height / 2 < door.height)
                    fail(section, key, "hangs over [door_" + door.name + "]");
    }

    const Ini& m_file;
    TWorld& m_world;
};

template <class ELEMENT>
void append(std::string& ini, const std::vector<ELEMENT>& all, const std::string& prefix) {
    for (const auto& element : all) ini += "\n" + element.asIni(prefix + element.name);
}

}  // namespace

TWorld loadWorld(const std::filesystem::path& file) {
    const auto ini = config::openStrict(file.string());
    TWorld world;
    world.file = file;
    CWorldReader(*ini, world).readAll();
    return world;
}

std::string asIni(const TWorld& world) {
    std::string ini = world.room.asIni("world") + "\n" + world.path.asIni("path") + "\n" +
                      world.laser.asIni("laser") + "\n" + world.camera.asIni("camera") + "\n" +
                      world.head.asIni("head") + "\n" + world.odometry.asIni("odometry") + "\n" +
                      world.people.asIni("people");
    append(ini, world.walls, "wall_");
    append(ini, world.doors, "door_");
    append(ini, world.boxes, "box_");
    append(ini, world.posters, "poster_");
    append(ini, world.lamps, "lamp_");
    return ini;
}

}  // namespace salma::simulator
