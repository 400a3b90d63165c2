#pragma once
#include <detent/query.h>

/// @file
/// Character movement: an upright capsule that follows a desired displacement, as far as the bodies of the world allow.
///
/// A mover is not a body: the caller keeps it as a `Mover`, and queries move it. It slides along walls and into
/// corners, climbs and descends steps, stands on slopes up to a limit, stays on the ground that it walks on, moves with
/// this ground, and moves out of bodies that overlap it.
///
/// Other bodies do not collide with a mover. To stop them, or to detect it, let the caller move a kinematic body or a
/// sensor with it (move_kinematic()), and set `MoverSettings::filter.ignore` to this body.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The size and the limits of a mover. They are not state: a replay needs the same settings and displacements.
struct MoverSettings {
  Real radius = Real(0.3);               ///< of the capsule, m, [2^-10, 2^10]; fx32: at least 2^-4
  Real half_length = Real(0.6);          ///< of its core segment, along up, m, [0, 2^10]; at most 2^10 times the radius
  Quat rotation = {0.0, 0.0, 0.0, 1.0};  ///< from its axes to the world's: y is up; normalised on entry
  Real gap = Real(0.01);                 ///< distance that it keeps from all bodies, m, [1/128, 1/4] of the radius
  Real step_height = Real(0.35);         ///< height of the highest step that it climbs, m, [0, 2^8]
  Real snap = Real(0.35);                ///< search distance below it for the ground that it walks on, m, [0, 2^8]
  Unit slope_cosine = Unit(0.707);       ///< cosine of the steepest slope that it stands on, [1/8, 1]
  Scaled push_force = 500.0;             ///< largest force behind MoverContact::impulse, N, [0, 2^60]
  QueryFilter filter = {};               ///< the bodies that it collides with
};

/// The complete state of a mover. To create one, set the position. It has no padding, and every byte is state: two
/// machines agree as long as these bytes are equal (if their byte orders differ: the bytes of save_mover()).
struct Mover {
  Position position = {0.0, 0.0, 0.0};  ///< of the capsule's centre, m, world
  BodyId ground = {};                   ///< the body that it stands on; null in the air
  /// The pose of `ground` at the end of the last move: the next move starts with the motion of the ground since then.
  /// Without ground: the origin, and no rotation.
  Pose ground_pose = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};
};
static_assert(sizeof(Mover) == sizeof(Position) * 2 + sizeof(BodyId) + sizeof(Quat));

/// A body that the mover hit.
struct MoverContact {
  BodyId body = {};        ///< the body
  Position point = {};     ///< on its surface, m, world
  Vec3<Unit> normal = {};  ///< of the body there, outward, world
  /// For apply_impulse_at_point(), N s, world. It gives a dynamic body the speed of the desired displacement, and is at
  /// most MoverSettings::push_force times a tick. 0 for other bodies, and for floors.
  Vec3<Scaled> impulse = {};
};

/// Capacity of MoverReport::contacts.
inline constexpr uint32_t k_mover_contacts_max = 8;

/// The result of a move.
struct MoverReport {
  Vec3<Real> carried = {};        ///< displacement by the motion of the ground, m, world
  Vec3<Real> recovered = {};      ///< displacement out of overlaps and gaps that are too small, m, world
  Vec3<Real> moved = {};          ///< displacement made for `displacement`, steps and slopes included, m, world
  bool on_ground = false;         ///< it stands on a floor
  bool stepped = false;           ///< it climbed a step
  Vec3<Unit> ground_normal = {};  ///< of the ground, or of a step's edge, world
  Real overlap = 0.0;             ///< depth of the overlap that remains, m: the mover is squeezed or stuck
  uint32_t contact_count = 0;     ///< entries of `contacts`
  uint32_t contacts_dropped = 0;  ///< contacts beyond k_mover_contacts_max
  uint32_t undecided = 0;         ///< undecided query hits: they stopped the mover
  uint32_t hits_dropped = 0;      ///< nearby bodies beyond those that it can process; it stops at them
  uint32_t slides_cut = 0;        ///< motions that ended early because they changed direction too often
  uint32_t queries = 0;           ///< queries made
  /// The first contact_count are used, in the order in which they were hit: one for each body, for a terrain one for
  /// each normal.
  MoverContact contacts[k_mover_contacts_max] = {};
};

/// Moves `mover` by `displacement`, m, world: the desired displacement for this tick, each component within 2^8. Its
/// part along up is falling and jumping, which the caller integrates. Call it once a tick, after step(), so that the
/// mover follows ground that moved.
///
///  - First the mover moves with the point of the ground that it stands on, and then out of bodies that overlap it.
///  - Then the horizontal part of the displacement is applied: full length over floors (measured horizontally), sliding
///    along walls. Anything steeper than a floor is a wall here. If a wall stops a mover that stood on the ground, it
///    tries to step up, and does so if the step ends on a floor.
///  - Then the part along up is applied. A mover that stood on the ground and does not rise moves down to a floor
///    within `snap`; if there is none, it falls.
///
/// A floor is a surface whose normal is within the slope limit of up, or an edge of such a surface.
/// Every motion is a cast of the part of the capsule that is free at its start, so the mover passes through nothing,
/// however fast it is. An undecided hit stops the mover, and is counted. Precision: that of the queries, and one step
/// of a position for each motion. Errors: out_of_range, not_normalised, feature_missing (capsules); then nothing
/// changes.
Status move_mover(const World& world, const MoverSettings& settings, const Vec3<Real>& displacement, Mover& mover,
                  MoverReport& report);

/// Bytes of a saved mover.
inline constexpr uint32_t k_mover_bytes = sizeof(Mover);
/// Writes the mover's members in their order, little-endian.
void save_mover(const Mover& mover, uint8_t (&bytes)[k_mover_bytes]);
/// Reads the bytes of save_mover(). Errors: out_of_range, not_normalised (the rotation of its ground).
Status load_mover(const uint8_t (&bytes)[k_mover_bytes], Mover& mover);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
