#pragma once
#include <detent/numbers.h>
#include <detent/shape.h>
#include <detent/status.h>

/// @file
/// Bodies: their ids, filters and definitions; getters and setters for the properties that a definition sets; forces,
/// impulses and kinematic targets. world.h has the functions that create, move and push a body.
///
/// Setters wake the body and the sleeping bodies that are in contact with it or joined to it. Errors of all getters:
/// bad_id. Errors of all setters: bad_id, and those that each setter lists.
namespace detent {
inline namespace DETENT_NAMESPACE {

struct World;

/// Names a body by value. The id is null if both members are zero. It is valid until the body is destroyed; a later
/// body in the same slot has another generation. A slot whose generation would overflow is no longer used, and is
/// counted in `WorldInfo::slots_retired`.
struct BodyId {
  uint32_t slot = 0;        ///< index of the body's slot, plus 1; 0: the null id
  uint32_t generation = 0;  ///< number of the body among the bodies that its slot has had; the first has 1
  /// Whether `a` and `b` name the same body.
  friend constexpr bool operator==(BodyId a, BodyId b) { return a.slot == b.slot && a.generation == b.generation; }
  /// An order for sorted containers: by slot, then by generation.
  friend constexpr bool operator<(BodyId a, BodyId b) {
    return a.slot < b.slot || (a.slot == b.slot && a.generation < b.generation);
  }
};
/// Whether the id is null. A null id names no body.
constexpr bool is_null(BodyId id) { return id.slot == 0; }
/// 64 bits for hash tables, different for different ids: the generation in the high half, the slot in the low half.
constexpr uint64_t hash_of(BodyId id) { return uint64_t{id.generation} << 32 | id.slot; }

/// Selects the bodies with which a body can collide. Two bodies of the same nonzero group can collide if the group is
/// positive, and cannot if it is negative. Any other two bodies can collide if the category of each shares a bit with
/// the mask of the other. Finally the filter rules of both bodies, if any, are called: a rule can forbid a pair that
/// these tests allow.
/// Source: the filter of Box2D (Catto).
struct Filter {
  uint32_t category = 1;  ///< bit set: the categories of the body
  uint32_t mask = ~0u;    ///< bit set: the categories with which the body can collide
  int32_t group = 0;      ///< number of the body's group; 0: no group
  uint32_t rule = 0;      ///< 0: no rule; else the number, from 1 on, of a rule in WorldHooks::filter_rules
  /// Whether all fields are equal.
  friend constexpr bool operator==(const Filter& a, const Filter& b) {
    return a.category == b.category && a.mask == b.mask && a.group == b.group && a.rule == b.rule;
  }
};

/// The properties of a body that a rule can read.
struct FilterBody {
  uint32_t user_data = 0;  ///< BodyDef::user_data
  Filter filter = {};      ///< BodyDef::filter
};

/// Returns whether `own`, the body that has the rule, can collide with `other`. The result must depend only on the
/// arguments, because the library may call the rule at any time. For the same arguments, the result must be the same on
/// every machine that simulates the world. A step makes these calls one at a time, even if it uses several threads
/// (WorldHooks::tasks).
using FilterRule = bool (*)(const FilterBody& own, const FilterBody& other);

/// The filter rules of a world. Rule n is rules[n - 1]. The caller chooses the order, which must be the same on every
/// machine: the state stores only the numbers.
struct FilterRuleTable {
  const FilterRule* rules = nullptr;  ///< the first rule
  uint32_t count = 0;                 ///< number of rules
};

/// How a body moves. Stored in snapshots and recordings: a value is never reused.
enum class BodyType : uint32_t {
  fixed = 1,      ///< never moves; infinite mass
  kinematic = 2,  ///< moves at the velocity that is set; forces and contacts do not change it
  dynamic = 3,    ///< moved by forces and contacts
};

/// How the two restitutions of a pair combine. Stored in snapshots and recordings: a value is never reused.
enum class RestitutionRule : uint32_t {
  larger = 0,  ///< the pair uses the larger restitution: a bouncy ball bounces on anything
  /// If either material has this rule, the pair uses the smaller restitution: a damping surface damps every body that
  /// hits it.
  smaller = 1,
};

/// Surface properties. A pair uses the geometric mean of the two frictions and the larger rolling resistance. It uses
/// the larger restitution, or the smaller one if either material has RestitutionRule::smaller.
struct Material {
  Real friction = Real(0.6);  ///< Coulomb's coefficient, [0, 16]
  Real restitution = 0.0;     ///< rebound speed over approach speed, [0, 1]
  /// The largest torque of rolling resistance about any axis, divided by (normal force x half the pair's smaller
  /// extent); [0, 16]. A body's extent is its smallest diameter (WorldDef), so half the extent of a ball is its radius.
  Real rolling_resistance = 0.0;
  /// The pair uses the smaller restitution if either material has the rule `smaller`.
  RestitutionRule restitution_rule = RestitutionRule::larger;
};

/// Bits for BodyDef::rotation_locks. Each bit locks the rotation of a dynamic body about one of its axes, as if the
/// inertia about this axis were infinite. Combine with |. Angular velocity about a locked axis is removed. If two axes
/// are locked, the third keeps its direction in the world: to keep a figure upright, lock x and z.
inline constexpr uint32_t k_rotation_lock_x = 1;
inline constexpr uint32_t k_rotation_lock_y = 2;     ///< locks the rotation about the body's y axis
inline constexpr uint32_t k_rotation_lock_z = 4;     ///< locks the rotation about the body's z axis
inline constexpr uint32_t k_rotation_locks_all = 7;  ///< no rotation at all

/// The properties of a body that `create_body` makes. Every field has a working default.
struct BodyDef {
  /// How the body moves; a half-space or a terrain (a mesh or height field) must be fixed or kinematic.
  BodyType type = BodyType::dynamic;
  Position position = {0.0, 0.0, 0.0};           ///< position of the centre of mass, m, world
  Quat rotation = {0.0, 0.0, 0.0, 1.0};          ///< local to world; length 1 within 2^-10, normalised on entry
  Vec3<Real> linear_velocity = {0.0, 0.0, 0.0};  ///< m/s, world; each component within +-16384
  /// Angular velocity, rad/s, world; each component x bounding radius within +-16384 m/s.
  Vec3<Real> angular_velocity = {0.0, 0.0, 0.0};
  /// The shape, in the body's frame, whose origin is the centre of mass.
  Shape shape = {};
  /// The material of the whole surface of the body.
  Material material = {};
  /// Density, kg/m^3, [2^-60, 2^60]. Used only for a dynamic body whose `mass` is 0. The resulting mass must be in
  /// [2^-60, 2^60] kg. The inertia is that of the shape at uniform density. About each axis it is at least 2^-15 mass
  /// r^2. Here r is the least power of two, m, above the bounding radius. For example, a rod of length 1.6 m that is
  /// thinner than 16 mm rotates about its length as if it were 16 mm thick.
  Scaled density = 1000.0;
  /// Mass, kg, [2^-60, 2^60]; 0: computed from the density. A non-dynamic body stores the mass for a later set_type().
  Scaled mass = 0.0;
  Real linear_damping = 0.0;    ///< 1/s, [0, 1024]
  Real angular_damping = 0.0;   ///< 1/s, [0, 1024]
  Real gravity_scale = 1.0;     ///< factor on the world's gravity, [-1024, 1024]
  uint32_t user_data = 0;       ///< stored, digested and recorded; only filter rules read it
  uint32_t rotation_locks = 0;  ///< k_rotation_lock_x, ...: body axes about which the body cannot rotate
  Filter filter = {};           ///< the bodies with which this body can collide
  /// A sensor has no contact forces, and queries and movers ignore it. It reports the bodies within it (sensor.h).
  bool sensor = false;
};

/// Gets a definition that creates the same body with its current pose and velocity. An inertia set by set_inertia() is
/// not part of it. The numbers are as the state stores them: rounded by less than 2^-30 of their magnitude. For a
/// non-dynamic body that never had a mass, `mass` is 0.
Status get_body_def(const World& world, BodyId id, BodyDef& def);
/// Gets BodyDef::type.
Status get_type(const World& world, BodyId id, BodyType& type);
/// Gets BodyDef::shape. A size that the shape's type does not use has its default value.
Status get_shape(const World& world, BodyId id, Shape& shape);
/// Gets BodyDef::material.
Status get_material(const World& world, BodyId id, Material& material);
/// Gets BodyDef::linear_damping and angular_damping, 1/s.
Status get_damping(const World& world, BodyId id, Real& linear, Real& angular);
/// Gets BodyDef::gravity_scale.
Status get_gravity_scale(const World& world, BodyId id, Real& scale);
/// Gets BodyDef::rotation_locks.
Status get_rotation_locks(const World& world, BodyId id, uint32_t& locks);
/// Gets BodyDef::sensor.
Status get_sensor(const World& world, BodyId id, bool& sensor);
/// Gets the moments of inertia about the body's axes, kg m^2; 0 for fixed and kinematic bodies and about locked axes.
Status get_inertia(const World& world, BodyId id, Vec3<Scaled>& inertia);
/// Gets the velocity, m/s, world, of the body's point at `arm` from its centre of mass. `arm`: m, world axes; each
/// component within twice the bounding radius. Errors: out_of_range.
Status get_velocity_at(const World& world, BodyId id, const Vec3<Real>& arm, Vec3<Real>& velocity);

/// Changes the type of the body and ends its contacts at once. Position, velocity and angular velocity stay, with two
/// exceptions: a body that becomes fixed stops, and a body that becomes dynamic loses the angular velocity about its
/// locked axes. Forces that have not acted yet are lost. A body that becomes dynamic gets the mass that it last had, or
/// that it was created with. If it never had a mass, it gets the mass of its shape at 1000 kg/m^3.
/// Errors: bad_argument (`type` is no BodyType; or `type` is dynamic and the shape is a half-space, a terrain, or a
/// hull in its source frame), out_of_range (the mass, or angular velocity x bounding radius).
Status set_type(World& world, BodyId id, BodyType type);
/// Changes the shape of the body and ends its contacts at once. Mass, velocity and angular velocity stay; set_density()
/// sets the mass from the new volume.
/// Errors: as create_body() with this shape, and out_of_range (angular velocity x bounding radius).
Status set_shape(World& world, BodyId id, const Shape& shape);
/// Sets the mass, kg, [2^-60, 2^60]. Velocity and angular velocity stay. A body that is not dynamic stores the mass for
/// a later set_type(). Errors: out_of_range.
Status set_mass(World& world, BodyId id, Scaled mass);
/// Sets the moments of inertia about the body's axes, kg m^2, in place of those of its shape. Range: [2^-15 mass r^2,
/// mass r^2], where r is the least power of two, m, above the bounding radius. The value about a locked axis has no
/// effect, but must be in (0, mass r^2]. The angular velocity stays. set_mass() scales the moments with the mass;
/// set_shape(), set_type() and set_rotation_locks() replace them by the moments of the shape.
/// Errors: bad_argument (the body is not dynamic), out_of_range.
Status set_inertia(World& world, BodyId id, const Vec3<Scaled>& inertia);
/// As set_mass(), with the mass `density` x volume of the shape. `density`: kg/m^3, [2^-60, 2^60].
/// Errors: out_of_range (the density or the mass), bad_argument (a half-space or a terrain).
Status set_density(World& world, BodyId id, Scaled density);
/// Sets BodyDef::material. Errors: bad_argument (restitution_rule is no RestitutionRule), out_of_range.
Status set_material(World& world, BodyId id, const Material& material);
/// Sets BodyDef::linear_damping and angular_damping, 1/s, [0, 1024]. Errors: out_of_range.
Status set_damping(World& world, BodyId id, Real linear, Real angular);
/// Sets BodyDef::gravity_scale, [-1024, 1024]. Errors: out_of_range.
Status set_gravity_scale(World& world, BodyId id, Real scale);
/// Sets BodyDef::rotation_locks. The angular velocity about the axes that are not locked stays. The inertia of the
/// shape replaces one that set_inertia() has set. Errors: bad_argument (other bits than those of k_rotation_locks_all).
Status set_rotation_locks(World& world, BodyId id, uint32_t locks);
/// Sets BodyDef::sensor. If the value changes, the body's contacts end at once. A body that becomes a sensor leaves the
/// sensors that it is within; if a sensor becomes an ordinary body, the bodies within it leave it. These changes cause
/// no leave events. Errors: pool_full (Capacity::sensed is 0), feature_missing.
Status set_sensor(World& world, BodyId id, bool sensor);

/// Adds a force, N, world frame, that acts during the next step at the point `arm` from the centre of mass. `arm`: m,
/// world axes; each component within twice the bounding radius. Errors: as apply_force().
Status apply_force_at(World& world, BodyId id, const Vec3<Scaled>& force, const Vec3<Real>& arm);
/// As apply_force_at(), but the force acts at `point`, a world position, m, which is at most twice the bounding radius
/// from the centre of mass in each component.
/// Errors: as apply_force().
Status apply_force_at_point(World& world, BodyId id, const Vec3<Scaled>& force, const Position& point);
/// As apply_impulse_at(), but the impulse acts at `point`, a world position, m, which is at most twice the bounding
/// radius from the centre of mass in each component. Errors: as apply_force().
Status apply_impulse_at_point(World& world, BodyId id, const Vec3<Scaled>& impulse, const Position& point);

/// The parameters of explode().
struct Explosion {
  Position centre = {0.0, 0.0, 0.0};  ///< m, world
  Real radius = 10.0;                 ///< m, [2^-14, 2^14]; the impulse decreases to 0 at this distance
  /// Impulse per area of a body's cross section, N s/m^2, for a body at the centre. A negative value pulls bodies
  /// towards the centre.
  Scaled impulse = 100.0;
};
/// Applies an impulse at once to each dynamic body whose distance d, defined below, is less than `radius`, in slot
/// order. The impulse acts at the centre of mass and points away from the centre of the explosion. Its magnitude is
///
///     impulse x pi b^2 x (1 - d / radius),   d = max(distance of the centres - b, 0),
///
/// where b is the bounding radius of the body, m. A body whose centre of mass is at the centre of the explosion gets no
/// impulse. Errors: out_of_range, also if the speed of a body would leave its range; then no body gets an impulse.
Status explode(World& world, const Explosion& explosion);

/// Sets the velocity and angular velocity of a kinematic body so that the next step moves it to the target pose, by the
/// smaller of the two possible rotations. The body keeps these velocities. After that step, the error of the pose is at
/// most 2^-31 m plus the resolution of a position (f32: plus 2^-23 of the displacement) in each coordinate, and 2^-27
/// (f32: 2^-21) in each component of the rotation (tests/unit/world/kinematic_test.cpp).
/// Errors: bad_id, bad_argument (not kinematic; a half-space that would rotate), out_of_range (a speed),
/// not_normalised.
Status move_kinematic(World& world, BodyId id, const Position& position, const Quat& rotation);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
