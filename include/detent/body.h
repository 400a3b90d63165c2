#pragma once
#include <detent/filter.h>
#include <detent/id.h>
#include <detent/scaled.h>
#include <detent/shape.h>

/// @file
/// The definition of a body.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// How a body moves. Stored in snapshots and recordings: a value is never reused.
enum class BodyType : uint32_t {
  fixed = 1,      ///< never moves; infinite mass
  kinematic = 2,  ///< moves at the velocity that is set; forces and contacts do not change it
  dynamic = 3,    ///< moved by forces and contacts
};

/// How the two restitutions of a pair combine. Stored in snapshots and recordings: a value is never reused.
enum class RestitutionRule : uint32_t {
  larger = 0,   ///< the larger one: a bouncy ball bounces on anything
  smaller = 1,  ///< the smaller one, if either material has this rule: a damping surface damps every body that hits it
};

/// Surface properties. A pair uses the geometric mean of the two frictions, the larger rolling resistance, and the
/// larger restitution unless one of the materials has RestitutionRule::smaller.
struct Material {
  Real friction = Real(0.6);      ///< Coulomb's coefficient, [0, 16]
  Real restitution = 0.0;         ///< rebound speed over approach speed, [0, 1]
  Real rolling_resistance = 0.0;  ///< torque over (normal force x smaller radius), about any axis, [0, 16]
  /// The pair uses the smaller restitution if either material has the rule `smaller`.
  RestitutionRule restitution_rule = RestitutionRule::larger;
};

/// Bits for the body axes about which a dynamic body cannot rotate, as if its inertia about them were infinite. Combine
/// with |. Angular velocity about a locked axis is removed. If two axes are locked, the third keeps its direction in
/// the world: to keep a figure upright, lock x and z.
inline constexpr uint32_t k_rotation_lock_x = 1;
inline constexpr uint32_t k_rotation_lock_y = 2;     ///< as k_rotation_lock_x, for the y axis
inline constexpr uint32_t k_rotation_lock_z = 4;     ///< as k_rotation_lock_x, for the z axis
inline constexpr uint32_t k_rotation_locks_all = 7;  ///< no rotation at all

/// The properties of a body that `create_body` makes. Every field has a working default.
struct BodyDef {
  /// How the body moves; a half-space or a terrain (a mesh or height field) must be fixed or kinematic.
  BodyType type = BodyType::dynamic;
  Position position = {0.0, 0.0, 0.0};           ///< of the centre of mass, m, world
  Quat rotation = {0.0, 0.0, 0.0, 1.0};          ///< local to world; length 1 within 2^-10, normalised on entry
  Vec3<Real> linear_velocity = {0.0, 0.0, 0.0};  ///< m/s, world; each component within +-16384
  /// Angular velocity, rad/s, world; each component x bounding radius within +-16384 m/s.
  Vec3<Real> angular_velocity = {0.0, 0.0, 0.0};
  /// In the body's frame, whose origin is the centre of mass.
  Shape shape = {};
  /// Applies to the whole surface of the body.
  Material material = {};
  /// kg/m^3, [2^-60, 2^60]; used for a dynamic body whose `mass` is 0. The resulting mass must be in [2^-60, 2^60] kg.
  /// The inertia is that of the shape at uniform density, but about each axis at least 2^-15 mass r^2, where r is the
  /// power of two, m, above the bounding radius. For example, a rod of length 1.6 m that is thinner than 16 mm rotates
  /// about its length as if it were 16 mm thick.
  Scaled density = 1000.0;
  /// kg, [2^-60, 2^60]; or 0: computed from the density. A body that is not dynamic stores it for a later set_type().
  Scaled mass = 0.0;
  Real linear_damping = 0.0;    ///< 1/s, [0, 1024]
  Real angular_damping = 0.0;   ///< 1/s, [0, 1024]
  Real gravity_scale = 1.0;     ///< factor on the world's gravity, [-1024, 1024]
  uint32_t user_data = 0;       ///< stored, digested and recorded; only filter rules read it
  uint32_t rotation_locks = 0;  ///< k_rotation_lock_x, ...: body axes about which the body cannot rotate
  Filter filter = {};           ///< what it collides with
  /// A sensor has no contact forces, and queries and movers ignore it. It reports the bodies within it (sensor.h).
  bool sensor = false;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
