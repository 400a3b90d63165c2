#pragma once
#include <detent/filter.h>
#include <detent/id.h>
#include <detent/scaled.h>
#include <detent/shape.h>

/// @file
/// What a body is made from.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// What moves a body. Stored in snapshots and recordings: a value is never reused.
enum class BodyType : uint32_t {
  fixed = 1,      ///< never moves; infinite mass
  kinematic = 2,  ///< moves by the velocity it is given, and nothing pushes it
  dynamic = 3,    ///< moved by forces and contacts
};

/// Which of two restitutions a pair takes. Stored in snapshots and recordings: a value is never reused.
enum class RestitutionRule : uint32_t {
  larger = 0,   ///< a bouncy ball bounces on anything
  smaller = 1,  ///< a damping surface damps whatever falls on it; one such material decides for the pair
};

/// How a surface behaves. A pair takes the geometric mean of friction, the larger rolling resistance, and the
/// larger restitution unless one of the two says otherwise.
struct Material {
  Real friction = Real(0.6);      ///< Coulomb's coefficient, [0, 16]
  Real restitution = 0.0;         ///< rebound speed over approach speed, [0, 1]
  Real rolling_resistance = 0.0;  ///< torque over (normal force x smaller radius), about any axis, [0, 16]
  /// One material that says `smaller` decides for the pair.
  RestitutionRule restitution_rule = RestitutionRule::larger;
};

/// Axes of a dynamic body about which nothing turns it, as if its inertia about them were infinite: add them up. Spin
/// about them is dropped. With two locked the third keeps its direction in the world: an upright figure locks x and z.
inline constexpr uint32_t k_turn_lock_x = 1;
inline constexpr uint32_t k_turn_lock_y = 2;     ///< likewise
inline constexpr uint32_t k_turn_lock_z = 4;     ///< likewise
inline constexpr uint32_t k_turn_locks_all = 7;  ///< it does not turn at all

/// What `create_body` makes. Every field has a working default.
struct BodyDef {
  /// What moves the body; a half-space is fixed or kinematic.
  BodyType type = BodyType::dynamic;
  Position position = {0.0, 0.0, 0.0};    ///< of the centre of mass, m, world
  Quat rotation = {0.0, 0.0, 0.0, 1.0};   ///< local to world; length 1 within 2^-10, normalised on entry
  Vec3<Real> velocity = {0.0, 0.0, 0.0};  ///< m/s, world; each component within +-16384
  Vec3<Real> spin = {0.0, 0.0, 0.0};      ///< rad/s, world; |spin| x bounding radius within 16384 m/s
  /// In the body's frame, around its centre of mass.
  Shape shape = {};
  /// Of the whole surface.
  Material material = {};
  /// kg/m^3, > 0; used where mass is 0; mass within [2^-60, 2^60] kg. Inertia is the shape's, evenly filled, but about
  /// each axis at least 2^-15 mass r^2, r the power of two, m, above the bounding radius: a rod of 1.6 m that is
  /// thinner than 16 mm turns about its length like one that is not.
  Scaled density = 1000.0;
  Scaled mass = 0.0;           ///< kg; 0: from the density. What is not dynamic keeps it for when it is.
  Real linear_damping = 0.0;   ///< 1/s, [0, 1024]
  Real angular_damping = 0.0;  ///< 1/s, [0, 1024]
  Real gravity_scale = 1.0;    ///< [-1024, 1024]
  uint32_t user_data = 0;      ///< kept, digested and recorded; read by filter rules alone
  uint32_t turn_locks = 0;     ///< k_turn_lock_x, ...: axes of the body about which it does not turn
  Filter filter = {};          ///< what it collides with
  /// It pushes nothing, nothing pushes it, and queries and movers do not meet it; it tells who is within it (sensor.h).
  bool sensor = false;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
