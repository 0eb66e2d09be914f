// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/simulator/TSensorOptions.h>
#include <salma/simulator/TWorldElements.h>

#include <filesystem>
#include <string>
#include <vector>

namespace salma::simulator {

/// Section [world]: what is common to all rooms.
struct TRoomOptions : public config::TStrictOptions<TRoomOptions> {
    double ceilingHeight{2.6};  //!< [m]
    std::string floor{"tiles"};
    std::string ceiling{"panels"};

    void visit(config::COptionVisitor& v);
};

/// Section [path]: where the robot drives.
struct TPathOptions : public config::TStrictOptions<TPathOptions> {
    std::vector<double> points;  //!< x and y of each corner in turn [m].
    bool closed{true};           //!< From the last point back to the first, which is one lap.
    int laps{2};
    double cornerRadius{0.9};              //!< [m]
    double speed{0.5};                     //!< [m/s]
    double turnRate{mrpt::DEG2RAD(30.0)};  //!< The robot slows down to keep it [rad/s].
    double acceleration{0.3};              //!< [m/s^2]
    double wander{0.06};         //!< Amplitude of its swaying to the sides, other in each lap [m].
    std::vector<double> floors;  //!< Floor of the way from each point to the next; empty: all 1.

    void visit(config::COptionVisitor& v);
    void validate() const;
};

/// A world as its file states it; every reference in it has been checked.
struct TWorld {
    std::filesystem::path file;
    TRoomOptions room;
    TPathOptions path;
    TLaserOptions laser;
    TCameraOptions camera;
    THeadOptions head;
    TOdometryOptions odometry;
    std::vector<TWall> walls;
    std::vector<TDoor> doors;
    std::vector<TBox> boxes;
    std::vector<TPoster> posters;
    std::vector<TLamp> lamps;
    TPeopleOptions people;

    /// "hallway-loop" of ".../hallway-loop.ini"; the names of all results begin so.
    std::string name() const { return file.stem().string(); }
    /// \throw std::out_of_range if there is no such wall.
    const TWall& wall(const std::string& wallName) const;
};

/** Reads a world file. Textures are names of textureNames() or picture files relative to it.
 * \throw std::invalid_argument one line naming file, section, key and value: unknown sections and
 * keys, values out of range, walls without length, doors and posters that leave their wall or
 * overlap a door, textures that do not exist, a path that cannot be driven. */
TWorld loadWorld(const std::filesystem::path& file);

/// The effective world as an ini file that loadWorld() reads again.
std::string asIni(const TWorld& world);

}  // namespace salma::simulator
