#pragma once
#include <detent/detail/state.h>

/// Work space of a step, in the block behind the persistent state. Nothing in it outlives a step.
namespace detent {
inline namespace DETENT_NAMESPACE {

struct Bounds {
  Position lower, upper;
};

/// A body during the substeps.
struct alignas(8) BodyWork {
  uint64_t colours;         ///< taken by the contacts of this body
  Quat rotation;            ///< now
  Vec3<Real> displacement;  ///< from the start of the tick, m
  Vec3<Real> turn;          ///< sum of spin x substep x 2^size_exponent from the start of the tick, m
  Vec3<Real> push;          ///< velocity that gravity and forces add in a substep, m/s
  Vec3<Real> twist;         ///< momentum that torques add in a substep, m/s
  Scaled linear_kept;       ///< share of the velocity that damping leaves in a substep
  Scaled angular_kept;
};

/// One direction of a contact: how an impulse along it acts on both bodies, and how their motion shows along it.
struct ContactRow {
  Vec3<Unit> arm_a, arm_b;            ///< (contact point - centre) x direction, in the body's unit of length
  Vec3<Unit> response_a, response_b;  ///< gyration (world) x arm, 2^-exponent
  int32_t exponent_a, exponent_b;
  Unit inverse_mass;  ///< effective mass over the pair's reference mass, in (0, 1]
};

struct ContactPoint {
  ContactRow row;
  Real separation;   ///< at the start of the tick, m
  Real approach;     ///< normal velocity at the start of the tick, m/s; negative when closing
  Real impulse_max;  ///< largest normal impulse of this tick, m/s
};

/// As ContactRow, for a spin about an axis of the contact: the arm is the axis, 2^-shift.
struct AngularRow {
  Vec3<Unit> response_a, response_b;
  int32_t exponent_a, exponent_b;
  Scaled inverse_mass;
};

/// A contact during the step. Impulses are over the reference mass: that of the lighter dynamic body.
struct alignas(8) ContactWork {
  ContactState state;  ///< becomes the world's contact when the step ends
  Vec3<Unit> normal;   ///< from A to B
  Vec3<Unit> tangent[2];
  ContactPoint point[k_manifold_points_max];
  ContactRow friction_row[2];
  AngularRow angular_row[3];  ///< about the normal and the tangents
  uint32_t angular_rows;      ///< 0; 1: twist; 3: and rolling
  uint32_t static_pair;       ///< 1 if only one of the bodies is dynamic
  int32_t shift_a, shift_b;   ///< the body's unit of length over the pair's, as a power of two
  Real friction_impulse[2];   ///< along the tangents
  Real angular_impulse[3];
  Scaled share_a, share_b;  ///< reference mass / mass; 0 if not dynamic
  Scaled friction;
  Scaled restitution;
  Scaled twist_arm;    ///< limit of the angular impulse about the normal over the normal impulse
  Scaled rolling_arm;  ///< likewise about the tangents
  Real push_max;       ///< largest separating speed of the position correction, m/s
  Real rebound_min;    ///< approach speed below which nothing rebounds, m/s
};

/// Where a contact stands in the order of the solve.
struct alignas(8) ContactOrder {
  uint64_t key;  ///< hash of the pair's ids
  uint32_t contact;
  uint32_t colour;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
