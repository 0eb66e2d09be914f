// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/core/bits_math.h>
#include <mrpt/math/TPoint2D.h>
#include <salma/config/TStrictOptions.h>

#include <string>
#include <vector>

namespace salma::simulator {

/** Section [wall_NAME]: an upright wall from the floor to the ceiling.
 *
 * As one faces it, `from_m` is its left end and `to_m` its right end; doors and posters are on that
 * side. Its own coordinates are u from the left end to the right and v from the floor up [m]. */
struct TWall : public config::TStrictOptions<TWall> {
    std::string name;          //!< What follows "wall_" in the section's name.
    std::vector<double> from;  //!< x and y [m].
    std::vector<double> to;    //!< x and y [m].
    std::string texture{"plaster"};
    double textureWidth{2};  //!< Of one repetition of a texture that is a file [m].
    int floor{1};            //!< On which it stands; only the robot's own floor is seen.

    void visit(config::COptionVisitor& v);
    mrpt::math::TPoint2D left() const { return {from[0], from[1]}; }
    mrpt::math::TPoint2D right() const { return {to[0], to[1]}; }
    double length() const { return (right() - left()).norm(); }
};

/// Section [door_NAME]: doors, their leaves set back into the wall; open in some laps.
struct TDoor : public config::TStrictOptions<TDoor> {
    std::string name;
    std::string wall;              //!< Name of its wall.
    std::vector<double> at;        //!< Centres along the wall [m]; one door for each.
    double width{0.9};             //!< [m]
    double height{2.05};           //!< [m]
    double depth{0.12};            //!< How far the leaf stands back [m].
    std::string texture{"door"};   //!< Of the leaf.
    std::vector<double> openLaps;  //!< Numbers of the laps in which they stand open, from 1 on.
    double closet{1.5};            //!< Depth of what is behind, seen when open [m].

    void visit(config::COptionVisitor& v);
    /// \throw std::invalid_argument
    void validate() const;
    bool isOpen(int lap) const;
};

/// Section [box_NAME]: a block such as a heater; the laser sees it if it reaches the beam's height.
struct TBox : public config::TStrictOptions<TBox> {
    std::string name;
    std::vector<double> centre;  //!< x and y [m].
    double yaw{0};               //!< Direction of its length [rad].
    double length{1};            //!< [m]
    double depth{0.15};          //!< Across its length [m].
    double bottom{0};            //!< Height of its underside [m].
    double top{0.6};             //!< Height of its upper side [m].
    std::string texture{"metal"};
    int floor{1};  //!< On which it stands.

    void visit(config::COptionVisitor& v);
    void validate() const;
};

/// Section [poster_NAME]: a flat picture on a wall.
struct TPoster : public config::TStrictOptions<TPoster> {
    std::string name;
    std::string wall;           //!< Name of its wall.
    double at{0};               //!< Centre along the wall [m].
    double centreHeight{1.45};  //!< [m]
    double width{0.6};          //!< With its border [m].
    double height{0.6};         //!< With its border [m].
    double border{0.015};       //!< Dark frame [m].
    std::string texture;
    double gloss{0};    //!< Share of a lamp's light that its glass mirrors [-].
    int movedInLap{0};  //!< From this lap on it hangs at `movedAt`; 0: it stays.
    double movedAt{0};  //!< Centre along the wall after the move [m].

    void visit(config::COptionVisitor& v);
    void validate() const;
    bool isMoved(int lap) const { return movedInLap > 0 && lap >= movedInLap; }
};

/// Section [lamp_NAME]: a lamp or bright window, seen where the glass of a poster mirrors it.
struct TLamp : public config::TStrictOptions<TLamp> {
    std::string name;
    std::vector<double> position;      //!< x, y and height [m].
    double brightness{2};              //!< In its middle, of white [-].
    double width{mrpt::DEG2RAD(8.0)};  //!< Sigma of its glow in the glass [rad].
    int floor{1};

    void visit(config::COptionVisitor& v);
};

/// Section [people]: who walks along the robot's path, other people in each run.
struct TPeopleOptions : public config::TStrictOptions<TPeopleOptions> {
    int count{0};
    double speed{0.9};    //!< Mean; each has a speed within 40 % of it, either way [m/s].
    double aside{0.65};   //!< Mean distance from the middle of the path, to either side [m].
    double radius{0.22};  //!< [m]
    double height{1.7};   //!< [m]

    void visit(config::COptionVisitor& v);
};

}  // namespace salma::simulator
