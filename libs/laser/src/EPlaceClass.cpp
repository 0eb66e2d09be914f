// SPDX-License-Identifier: BSD-3-Clause
#include <salma/laser/EPlaceClass.h>

namespace salma::laser {
namespace {

constexpr std::array<const char*, kPlaceClasses> kNames{
    "corridor", "T left",   "T right",     "T ahead",      "L left",
    "L right",  "dead end", "corner left", "corner right", "open"};

}  // namespace

const char* asString(EPlaceClass place) { return kNames[static_cast<std::size_t>(place)]; }

std::optional<EPlaceClass> placeClassOf(const std::string& name) {
    for (std::size_t i = 0; i < kPlaceClasses; ++i)
        if (name == kNames[i]) return static_cast<EPlaceClass>(i);
    return std::nullopt;
}

EPlaceClass mirrored(EPlaceClass place) {
    switch (place) {
        case EPlaceClass::teeLeft:
            return EPlaceClass::teeRight;
        case EPlaceClass::teeRight:
            return EPlaceClass::teeLeft;
        case EPlaceClass::bendLeft:
            return EPlaceClass::bendRight;
        case EPlaceClass::bendRight:
            return EPlaceClass::bendLeft;
        case EPlaceClass::cornerLeft:
            return EPlaceClass::cornerRight;
        case EPlaceClass::cornerRight:
            return EPlaceClass::cornerLeft;
        default:
            return place;
    }
}

}  // namespace salma::laser
