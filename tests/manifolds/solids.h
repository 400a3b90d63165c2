#pragma once
#include "tests/manifolds/scene.h"
#include "tests/oracle/random_solids.h"

/// The solids of the pairs, and how they are laid on a face, an edge or a corner.
namespace detent_manifolds {

using detent_oracle::Dice;

/// Which part of a solid lies on the other.
enum class Part { face, edge, corner, rim };

/// A solid that has such a part: box, cylinder, capsule, cone, sphere or hull. Its largest half extent is about `size`,
/// m; it is up to 100 times as long as it is thin.
Solid random_solid(Dice& dice, Part part, double size);
Solid box_of(const Triple& half);

/// A direction in the solid's frame along which the part is what lies farthest out, one in the part, and its middle.
struct Seat {
  Arrow out, along, middle;
};
Seat random_seat(Dice& dice, const Solid& solid, Part part);

/// A multiple of 2^-20 m of at most 24 bits.
double held(double length);

}  // namespace detent_manifolds
