#pragma once
#include <stdint.h>

#include <array>
#include <string>
#include <vector>

#include "tests/common/support/ground.h"

/// The scenes of the stress tests and of the whole-step benchmark, in plain numbers that are the same for every engine.
/// SI units, Y up.
namespace detent_stress {

enum class Solid : uint32_t {
  box,          ///< size: half extents
  sphere,       ///< size[0]: radius
  capsule,      ///< size[0]: radius, size[1]: half length of the core, along y
  icosahedron,  ///< size[0]: radius of its 12 vertices
  half_space,   ///< below the body's origin; of a fixed body
};

enum class Role : uint32_t { fixed, kinematic, dynamic };

struct StageBody {
  Solid solid = Solid::box;
  Role role = Role::dynamic;
  double size[3] = {0.5, 0.5, 0.5};
  double position[3] = {0, 0, 0};          ///< of the centre of mass, m
  double rotation[4] = {0, 0, 0, 1};       ///< x, y, z, w
  double linear_velocity[3] = {0, 0, 0};   ///< m/s
  double angular_velocity[3] = {0, 0, 0};  ///< rad/s, world
  double density = 1000;                   ///< kg/m^3
  double mass = 0;                         ///< kg; 0: from the density
  double friction = 0.6;                   ///< of a pair: the geometric mean of both
  double restitution = 0;                  ///< of a pair: the larger of both
};

/// A ball joint: keeps a point of A and a point of B together.
struct StageJoint {
  uint32_t a = 0, b = 0;           ///< indices of bodies, at least one of them dynamic
  double anchor_a[3] = {0, 0, 0};  ///< from A's centre of mass, m, A's axes
  double anchor_b[3] = {0, 0, 0};  ///< from B's centre of mass, m, B's axes
};

struct Stage {
  std::string name;
  std::vector<StageBody> bodies;  ///< fixed bodies first
  std::vector<StageJoint> joints;
  bool collisions = true;  ///< whether bodies collide
  double gravity = 9.81;   ///< m/s^2, downwards
  double tick = 1.0 / 60;  ///< s
  double unit = 1;         ///< m: the scale of the scene; 1 in scenes.md
  uint32_t ticks = 600;
  bool sleeping = false;
};

/// The state of a body of a stage at some tick, in the same units.
struct BodyState {
  double position[3] = {0, 0, 0};
  double rotation[4] = {0, 0, 0, 1};  ///< x, y, z, w
  double linear_velocity[3] = {0, 0, 0};
  double angular_velocity[3] = {0, 0, 0};
};
using States = std::vector<BodyState>;
States states_at_start(const Stage& stage);
/// The world position of a body's point, m; `point` is given from its centre of mass, m, in its axes.
std::array<double, 3> point_of(const BodyState& state, const double (&point)[3]);

/// Multiplies every length and position by `factor`, and every speed and time by its square root. So the same motion
/// appears under the same gravity; the tick is scaled as a time.
Stage scaled(const Stage& stage, double factor);
/// Moves everything by (distance, distance, distance): whole metres, below 2^24. Positions are rounded to 2^-28 m
/// first, so that the sum is exact; compare a moved stage with moved(stage, 0).
Stage moved(const Stage& stage, double distance);
/// A variant of the scene: movable bodies in a random order of creation, and the whole scene rotated about y by a
/// random angle. Seed 0 changes nothing.
Stage varied(const Stage& stage, uint64_t seed);

/// Whether the stage has one level ground, a half-space or a wide box.
bool has_ground(const Stage& stage);
/// The stage with its ground replaced; unchanged if it has none.
Stage on_ground(const Stage& stage, detent_test::Ground ground);

/// The mass, kg, of a body of any role.
double mass_of(const StageBody& body);
/// Principal moments of inertia per unit mass about the body's axes, m^2.
std::array<double, 3> inverse_inertia_of(const StageBody& body);
/// The radius of a sphere about the centre of mass that contains the body, m.
double bounding_radius(const StageBody& body);
/// The vertices of an icosahedron with this circumradius, m.
std::vector<std::array<double, 3>> icosahedron_points(double radius);

}  // namespace detent_stress
