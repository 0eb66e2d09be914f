// SPDX-License-Identifier: BSD-3-Clause
#include <salma/simulator/TWorldElements.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace salma::simulator {

using config::anyNumber;
using config::atLeast;
using config::between;
using config::COptionVisitor;
using config::moreThan;

void TWall::visit(COptionVisitor& v) {
    v.numbers("from_m", from, anyNumber(), "left end as one faces the wall: x y");
    v.numbers("to_m", to, anyNumber(), "right end as one faces the wall: x y");
    v.text("texture", texture, "built-in name or picture file");
    v.number("texture_width_m", textureWidth, moreThan(0), "width of a picture file's repetition");
    v.integer("floor", floor, between(1, 9), "on which it stands");
}

void TDoor::visit(COptionVisitor& v) {
    v.text("wall", wall, "name of its wall");
    v.numbers("at_m", at, atLeast(0), "centres of equal doors along the wall, from its left end");
    v.number("width_m", width, between(0.3, 5), "width of the opening");
    v.number("height_m", height, between(0.5, 10), "height of the opening");
    v.number("depth_m", depth, between(0.01, 1), "how far the leaf stands back");
    v.text("texture", texture, "of the leaf: built-in name or picture file");
    v.numbers("open_laps", openLaps, atLeast(1), "laps in which it stands open, from 1 on");
    v.number("closet_m", closet, between(0.1, 10), "depth of what is behind it");
}

void TDoor::validate() const {
    for (const double lap : openLaps)
        if (lap != std::floor(lap))
            throw std::invalid_argument("open_laps = " + std::to_string(lap) +
                                        " is not a whole number");
}

bool TDoor::isOpen(int lap) const {
    return std::find(openLaps.begin(), openLaps.end(), lap) != openLaps.end();
}

void TBox::visit(COptionVisitor& v) {
    v.numbers("centre_m", centre, anyNumber(), "centre on the floor: x y");
    v.degrees("yaw_deg", yaw, between(-360, 360), "direction of its length");
    v.number("length_m", length, moreThan(0), "extent along yaw_deg");
    v.number("depth_m", depth, moreThan(0), "extent across yaw_deg");
    v.number("bottom_m", bottom, atLeast(0), "height of its underside");
    v.number("top_m", top, moreThan(0), "height of its upper side");
    v.text("texture", texture, "built-in name or picture file");
    v.integer("floor", floor, between(1, 9), "on which it stands");
}

void TBox::validate() const {
    if (!(bottom < top))
        throw std::invalid_argument("bottom_m = " + std::to_string(bottom) +
                                    " must be below top_m = " + std::to_string(top));
}

void TPoster::visit(COptionVisitor& v) {
    v.text("wall", wall, "name of its wall");
    v.number("at_m", at, atLeast(0), "centre along the wall, from its left end");
    v.number("centre_height_m", centreHeight, moreThan(0), "height of its centre");
    v.number("width_m", width, moreThan(0), "width with its border");
    v.number("height_m", height, moreThan(0), "height with its border");
    v.number("border_m", border, atLeast(0), "dark frame around the picture");
    v.text("texture", texture, "picture file or built-in name");
    v.number("gloss", gloss, between(0, 1), "share of a lamp's light that its glass mirrors");
    v.integer("moved_in_lap", movedInLap, between(0, 100),
              "from this lap on it hangs at moved_at_m; 0: it stays");
    v.number("moved_at_m", movedAt, atLeast(0), "centre along the wall after the move");
}

void TPoster::validate() const {
    if (!(2 * border < width && 2 * border < height))
        throw std::invalid_argument("border_m = " + std::to_string(border) +
                                    " leaves nothing of the picture");
}

void TLamp::visit(COptionVisitor& v) {
    v.numbers("position_m", position, anyNumber(), "x, y and height");
    v.number("brightness", brightness, between(0, 100), "of its middle, where white is 1");
    v.degrees("width_deg", width, between(0.5, 60), "sigma of its glow in glass");
    v.integer("floor", floor, between(1, 9), "on which it hangs");
}

void TPeopleOptions::visit(COptionVisitor& v) {
    v.integer("count", count, between(0, 100), "who walk along the path");
    v.number("speed_mps", speed, between(0.05, 3), "mean, either way");
    v.number("aside_m", aside, between(0, 5), "mean distance from the path, to either side");
    v.number("radius_m", radius, between(0.05, 1), "of a person");
    v.number("height_m", height, between(0.5, 2.5), "of a person");
}

}  // namespace salma::simulator
