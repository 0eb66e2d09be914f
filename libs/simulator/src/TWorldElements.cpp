// SPDX-License-Identifier: BSD-3-Clause
#include <salma/simulator/TWorldElements.h>

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
}

void TDoor::visit(COptionVisitor& v) {
    v.text("wall", wall, "name of its wall");
    v.numbers("at_m", at, atLeast(0), "centres of equal doors along the wall, from its left end");
    v.number("width_m", width, between(0.3, 5), "width of the opening");
    v.number("height_m", height, between(0.5, 10), "height of the opening");
    v.number("depth_m", depth, between(0.01, 1), "how far the leaf stands back");
    v.text("texture", texture, "of the leaf: built-in name or picture file");
}

void TBox::visit(COptionVisitor& v) {
    v.numbers("centre_m", centre, anyNumber(), "centre on the floor: x y");
    v.degrees("yaw_deg", yaw, between(-360, 360), "direction of its length");
    v.number("length_m", length, moreThan(0), "extent along yaw_deg");
    v.number("depth_m", depth, moreThan(0), "extent across yaw_deg");
    v.number("bottom_m", bottom, atLeast(0), "height of its underside");
    v.number("top_m", top, moreThan(0), "height of its upper side");
    v.text("texture", texture, "built-in name or picture file");
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
}

void TPoster::validate() const {
    if (!(2 * border < width && 2 * border < height))
        throw std::invalid_argument("border_m = " + std::to_string(border) +
                                    " leaves nothing of the picture");
}

}  // namespace salma::simulator
