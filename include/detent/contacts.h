#pragma once
#include <detent/world.h>

/// Reading contacts: pairs of bodies that have contact points, as the last step left them.
///
///     for (uint32_t i = next_contact(world, id, 0); i < get_info(world).contacts; i = next_contact(world, id, i + 1))
///     {
///       Contact contact;
///       if (get_contact(world, i, contact) == Status::ok) ...
///     }
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Where two bodies touch.
struct ContactPoint {
  Position position = {0.0, 0.0, 0.0};  ///< midway between the surfaces, m, world
  Real separation = 0.0;                ///< m; negative where they overlap
  uint32_t feature = 0;                 ///< which features meet: the same as long as they do, distinct in a contact
  uint32_t child_a = 0;                 ///< of A, if it is a compound: which touches here, counted from 1; else 0
  uint32_t child_b = 0;                 ///< of B, likewise
  Scaled normal_impulse = 0.0;          ///< N s, of the last tick
};

/// A pair of bodies in contact, or one of the up to eight contacts of a pair with a surface or compound: what touches
/// in one plane is one. Impulses
/// and forces are those of the last substep, taken for the whole tick: the bodies' state holds no others. They are what
/// rests on what; a blow shows in its event (event.h). Bodies that sleep keep theirs.
struct Contact {
  BodyId a;                            ///< the body of the lower slot
  BodyId b;                            ///< the other
  Vec3<Unit> normal = {};              ///< from A to B, world; zero where there is no point
  uint32_t part = 0;                   ///< 0 between convex bodies; else another one for each contact of the pair
  bool touching = false;               ///< they pushed each other in the last step
  uint32_t age = 0;                    ///< ticks in contact before the last one, at most 65535
  uint32_t point_count = 0;            ///< at most 4
  ContactPoint point[4] = {};          ///< the first `point_count`
  Vec3<Scaled> friction_impulse = {};  ///< on B, N s, world, of the last tick
  Scaled normal_impulse = 0.0;         ///< of all points, N s
  Scaled normal_force = 0.0;           ///< mean over the tick, N
};

/// The contact `index` of the get_info(world).contacts there are, in the order of (a.slot, b.slot, part). Points are
/// found anew where the bodies are now, which takes what colliding the pair takes; there are none if they have parted
/// since. A point that meets with a feature that the last step did not know has no impulse. Errors: out_of_range (the
/// index).
Status get_contact(const World& world, uint32_t index, Contact& contact);
/// The first index, from `index` on, of a contact of this body; the number of contacts if there is none.
uint32_t next_contact(const World& world, BodyId id, uint32_t index);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
