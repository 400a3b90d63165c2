#pragma once
#include <detent/query.h>

/// @file
/// A character: an upright capsule that goes where its user wishes, as far as the world lets it.
///
/// It is no body, and a world knows nothing of it: it is the caller's `Mover`, moved by queries. It slides along walls
/// and into corners, climbs and descends steps, stands on slopes up to a limit, stays on the ground that it walks on,
/// goes where that carries it, and gets out of what has moved into it.
///
/// A body that shall stop others in its place (kinematic, led by move_kinematic(), or a sensor) is the caller's, and
/// `MoverSettings::filter.ignore` names it.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// What a mover is and may. A constant of the caller's, as important to a replay as the wishes.
struct MoverSettings {
  Real radius = Real(0.3);               ///< of the capsule, m, [2^-10, 2^10]; fx32: at least 2^-4
  Real half_length = Real(0.6);          ///< of its core, along up, m, [0, 2^10], and at most 2^10 of the radius
  Quat rotation = {0.0, 0.0, 0.0, 1.0};  ///< from its axes to the world's: y is up; normalised on entry
  Real gap = Real(0.01);                 ///< kept from everything, m, [1/128, 1/4] of the radius
  Real step_height = Real(0.35);         ///< of the highest step that it climbs, m, [0, 2^8]
  Real snap = Real(0.35);                ///< how far below itself it looks for the ground that it walks on, m, [0, 2^8]
  Unit slope_cosine = Unit(0.707);       ///< of the steepest slope that it stands on, [1/8, 1]
  Scaled push_force = 500.0;             ///< of MoverContact::impulse, at most, N, [0, 2^60]
  QueryFilter filter = {};               ///< whom it meets
};

/// The whole state of a mover. To make one, set the position. It has no padding byte, and all of it matters: two
/// machines are in step as long as its bytes are equal (of another byte order: save_mover()).
struct Mover {
  Position position = {0.0, 0.0, 0.0};  ///< of the capsule's centre, m, world
  BodyId ground = {};                   ///< the body that it stands on; null in the air
  /// Where `ground` was then: it carries the mover to where it is now. If there is none, at the origin, unturned.
  Pose ground_pose = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};
};
static_assert(sizeof(Mover) == sizeof(Position) * 2 + sizeof(BodyId) + sizeof(Quat));

/// A body that stood in the way.
struct MoverContact {
  BodyId body = {};        ///< whom it met
  Position point = {};     ///< on its surface, m, world
  Vec3<Unit> normal = {};  ///< of the body there, outward, world
  /// For apply_impulse_at_point(), N s, world: what gives a dynamic body the speed of the wish, but no more than
  /// MoverSettings::push_force in a tick. 0 for other bodies, and for floors.
  Vec3<Scaled> impulse = {};
};

/// Contacts that a report holds.
inline constexpr uint32_t k_mover_contacts_max = 8;

/// What a move came to.
struct MoverReport {
  Vec3<Real> carried = {};        ///< by the ground, m, world
  Vec3<Real> recovered = {};      ///< out of what the mover was in or too near to, m, world
  Vec3<Real> moved = {};          ///< of the wish, steps and slopes included, m, world
  bool on_ground = false;         ///< it stands on a floor
  bool stepped = false;           ///< it climbed a step
  Vec3<Unit> ground_normal = {};  ///< of the ground, world; of a step's edge too
  Real overlap = 0.0;             ///< how deep it still is in something, m: it is squeezed, or caught
  uint32_t contact_count = 0;     ///< of the contacts
  uint32_t contacts_dropped = 0;  ///< beyond k_mover_contacts_max
  uint32_t undecided = 0;         ///< hits of queries that met a cap: they stopped the mover
  uint32_t hits_dropped = 0;      ///< bodies around the mover beyond those that it can look at; it stops at them
  uint32_t slides_cut = 0;        ///< motions that ended for the number of their turns
  uint32_t queries = 0;           ///< asked
  MoverContact contacts[k_mover_contacts_max] = {};  ///< the first contact_count, in the order they were met, one a
                                                     ///< body, of a surface() one for each normal
};

/// Moves `mover` by `way`, m, world: the wish for this tick, each component within 2^8; falling and jumping, the
/// caller's to add up, are its part along up. Call it once a tick, after step(), so that the ground that moved carries
/// it.
///
///  - It goes where the ground's motion takes the place that it stands on, and then out of what overlaps it.
///  - The part of the way across up is gone next: over floors at its full length (measured level), along walls as far
///  as
///    they let it. What is steeper than a floor is a wall here. Where a wall stops it that stood on the ground, it
///    tries a step up, and takes it if that ends on a floor.
///  - Then the part along up. A mover that stood on the ground and does not rise goes down to the floor below it, if
///  that
///    is within `snap`; without one it falls.
///
/// A floor is a surface whose normal is within the slope limit of up, and an edge of one.
/// Every motion is a cast of the part of the capsule that is free at its start: nothing is passed through, however
/// fast. A cap is never "free": it stops the mover, and is counted. Precision: that of the queries; a position's step a
/// motion. Errors: out_of_range, not_normalised, feature_missing (capsules); nothing is changed then.
Status move_mover(const World& world, const MoverSettings& settings, const Vec3<Real>& way, Mover& mover,
                  MoverReport& report);

/// Of a saved mover.
inline constexpr uint32_t k_mover_bytes = sizeof(Mover);
/// The mover's words in their order, little-endian.
void save_mover(const Mover& mover, uint8_t (&bytes)[k_mover_bytes]);
/// The reverse. Errors: out_of_range, not_normalised (the rotation of its ground).
Status load_mover(const uint8_t (&bytes)[k_mover_bytes], Mover& mover);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
