#pragma once
#include <detent/world.h>

/// Getters for contacts: pairs of bodies with contact points, in the state after the last step.
///
///     for (uint32_t i = next_contact(world, id, 0); i < get_info(world).contacts; i = next_contact(world, id, i + 1))
///     {
///       Contact contact;
///       if (get_contact(world, i, contact) == Status::ok) ...
///     }
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A contact point of two bodies.
struct ContactPoint {
  Position position = {0.0, 0.0, 0.0};  ///< midway between the surfaces, m, world
  Real separation = 0.0;                ///< m; negative where the bodies overlap
  uint32_t feature = 0;                 ///< names the features that meet: constant while they do, distinct in a contact
  uint32_t child_a = 0;                 ///< if A is a compound: its child at this point, counted from 1; else 0
  uint32_t child_b = 0;                 ///< if B is a compound: its child at this point, counted from 1; else 0
  Scaled normal_impulse = 0.0;          ///< N s, over the last tick
};

/// A contact of two bodies. A pair of convex bodies has one contact. A pair with a compound or a terrain (a mesh or
/// height field) has up to eight: points in one plane form one contact. The state stores only the impulses of the last
/// substep; the impulses and forces here are these, scaled to the whole tick. They show the resting load; an impact
/// shows in its event (event.h). The contacts of sleeping bodies keep their impulses.
struct Contact {
  BodyId a;                    ///< the body with the lower slot
  BodyId b;                    ///< the body with the higher slot
  Vec3<Unit> normal = {};      ///< from A to B, world; zero if there is no point
  uint32_t part = 0;           ///< 0 between convex bodies; else a different number for each contact of the pair
  bool touching = false;       ///< the bodies pushed each other in the last step
  uint32_t age = 0;            ///< ticks in contact before the last one, at most 65535
  uint32_t point_count = 0;    ///< number of points, at most 4
  ContactPoint point[4] = {};  ///< the first `point_count` are in use
  Vec3<Scaled> friction_impulse = {};  ///< on B, N s, world, over the last tick
  Scaled normal_impulse = 0.0;         ///< of all points, N s, over the last tick
  Scaled normal_force = 0.0;           ///< of all points, mean over the tick, N
};

/// Reads the contact `index`, 0 to get_info(world).contacts - 1, in the order of (a.slot, b.slot, part). The points are
/// computed for the current poses of the bodies, which costs as much as colliding the pair in a step. If the bodies
/// have moved apart since the step, there are no points. A point between features that did not meet in the last step
/// has impulse 0. Errors: out_of_range (the index).
Status get_contact(const World& world, uint32_t index, Contact& contact);
/// The index of the first contact of this body at or after `index`; the number of contacts if there is none, or if `id`
/// is not valid.
uint32_t next_contact(const World& world, BodyId id, uint32_t index);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
