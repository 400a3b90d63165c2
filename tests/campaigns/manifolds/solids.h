#pragma once
#include "tests/campaigns/manifolds/scene.h"
#include "tests/common/oracle/random_solids.h"

/// The solids of the pairs, and their resting face, edge or corner.
namespace detent_manifolds {

using detent_oracle::Dice;

/// The part of a solid that touches the other one.
enum class Part { face, edge, corner, rim };

/// A random solid with such a part: box, cylinder, capsule, cone, sphere or hull. Its largest half extent is about
/// `size`, m; its length is up to 100 times its thickness.
Solid random_solid(Dice& dice, Part part, double size);
Solid box_of(const Triple& half);

/// In the solid's frame: the direction in which the part is the support feature, a direction in the part, and its
/// middle.
struct Seat {
  Arrow out, along, middle;
};
Seat random_seat(Dice& dice, const Solid& solid, Part part);

/// Rounds to a multiple of 2^-20 m of at most 24 bits.
double held(double length);

}  // namespace detent_manifolds
