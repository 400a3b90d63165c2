#pragma once
#include <detent/query.h>

/// @file
/// Character movement: an upright capsule that follows a desired displacement, as far as the bodies of the world allow.
///
/// A mover is not a body: the caller keeps it as a `Mover`, and queries move it. It slides along walls and into
/// corners, climbs and descends steps, stands on slopes up to a limit, stays on the ground that it walks on, moves with
/// this ground, and moves out of bodies that overlap it.
///
/// Bodies do not collide with a mover. If a mover should stop bodies, or if sensors should detect it, the caller moves
/// a kinematic body or a sensor along with it (move_kinematic()), and sets `MoverSettings::filter.ignore` to this body.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The size and the limits of a mover. They are not stored in the world or the mover; a replay must pass the same
/// settings and displacements.
struct MoverSettings {
  Real radius = Real(0.3);  ///< radius of the capsule, m, [2^-10, 2^10]; fx32: at least 2^-4
  /// Half the length of the capsule's core segment, which points up, m, [0, 2^10]; at most 2^10 times the radius.
  Real half_length = Real(0.6);
  Quat rotation = {0.0, 0.0, 0.0, 1.0};  ///< the mover's axes to the world's; its y axis is up; normalised on entry
  Real gap = Real(0.01);                 ///< distance that the mover keeps from bodies, m, [1/128, 1/4] of the radius
  Real step_height = Real(0.35);         ///< height of the highest step that it climbs, m, [0, 2^8]
  Real snap = Real(0.35);                ///< largest descent of a walking mover to a floor below it, m, [0, 2^8]
  Unit slope_cosine = Unit(0.707);       ///< cosine of the steepest slope that it stands on, [1/8, 1]
  Scaled push_force = 500.0;             ///< largest force that the mover pushes bodies with, N, [0, 2^60]
  QueryFilter filter = {};               ///< the bodies that the mover collides with
};

/// The complete state of a mover. To create one, set the position. It has no padding, and every byte is state: two
/// machines agree as long as these bytes are equal. Machines of different byte orders compare the bytes that
/// save_mover() writes.
struct Mover {
  Position position = {0.0, 0.0, 0.0};  ///< position of the capsule's centre, m, world
  BodyId ground = {};                   ///< the body that it stands on; null in the air
  /// The pose of `ground` at the end of the last move. The next move first moves the mover by the motion of the ground
  /// since then. Without ground: the origin, and no rotation.
  Pose ground_pose = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};
};
static_assert(sizeof(Mover) == sizeof(Position) * 2 + sizeof(BodyId) + sizeof(Quat));

/// A body that the mover hit.
struct MoverContact {
  BodyId body = {};        ///< the body
  Position point = {};     ///< the point of contact on the body's surface, m, world
  Vec3<Unit> normal = {};  ///< the body's outward normal at `point`, world
  /// An impulse, N s, world, which the caller can pass to apply_impulse_at_point(). Along the normal, it accelerates
  /// the body to the speed of the desired displacement, but it is at most MoverSettings::push_force x the length of a
  /// tick. 0 for a floor, for a body that is not dynamic, and for a body that is not slower than the displacement.
  Vec3<Scaled> impulse = {};
};

/// Capacity of MoverReport::contacts.
inline constexpr uint32_t k_mover_contacts_max = 8;

/// The result of a move.
struct MoverReport {
  Vec3<Real> carried = {};    ///< displacement by the motion of the ground, m, world
  Vec3<Real> recovered = {};  ///< displacement that restored the gap to bodies that were too near, m, world
  /// The rest of the mover's displacement, which follows the argument `displacement`; steps and slopes are included, m,
  /// world.
  Vec3<Real> moved = {};
  bool on_ground = false;         ///< the mover stands on a floor
  bool stepped = false;           ///< the mover climbed a step
  Vec3<Unit> ground_normal = {};  ///< normal of the ground, or of the edge of a climbed step, world
  Real overlap = 0.0;             ///< depth of the overlap that remains, m; above 0 if the mover is squeezed or stuck
  uint32_t contact_count = 0;     ///< number of elements of `contacts` that are in use
  uint32_t contacts_dropped = 0;  ///< number of contacts beyond k_mover_contacts_max
  uint32_t undecided = 0;         ///< number of undecided query hits; each of them stopped the mover
  uint32_t hits_dropped = 0;      ///< number of query hits and contact planes that the move had no room to process
  uint32_t slides_cut = 0;        ///< number of motions that ended early, because they changed direction too often
  uint32_t queries = 0;           ///< number of queries that the move made
  /// The first contact_count elements are in use, in the order in which the mover hit them: one element for each body,
  /// and for a terrain one for each normal.
  MoverContact contacts[k_mover_contacts_max] = {};
};

/// Moves `mover` by `displacement`, m, world: the desired displacement for this tick, each component within 2^8. Its
/// component along up must include falling and jumping, which the caller integrates. Call move_mover() once a tick,
/// after step(), so that the mover follows ground that moved.
///
///  - First the mover moves with the point of the ground on which it stands. Then it moves out of bodies that overlap
///    it.
///  - Then the horizontal part of the displacement is applied. Over floors, even sloped ones, the mover covers the full
///    length of this part horizontally. It slides along walls; a wall is any surface steeper than a floor. If a wall
///    stops a mover that stood on the ground, the mover tries to climb it as a step, and does so if the step ends on a
///    floor.
///  - Then the part along up is applied. A mover that stood on the ground and does not rise moves down to a floor
///    within `snap`; if there is none, it falls.
///
/// A floor is a surface whose slope is at most that of MoverSettings::slope_cosine, or an edge of such a surface.
/// For every motion the capsule is cast. If it overlaps bodies at the start, a thinner capsule that overlaps none is
/// cast instead. Therefore a mover does not pass through a body at any speed. An undecided hit stops the mover, and
/// MoverReport::undecided counts it. Precision: that of the queries, plus the resolution of a position for each motion.
/// Errors: out_of_range, not_normalised, feature_missing (the world lacks Features::capsule); after an error nothing
/// has changed.
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
