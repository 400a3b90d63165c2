#pragma once
#include <stdint.h>

#include <array>
#include <string>
#include <vector>

/// The scenes of the stress tests and of the whole-step benchmark, in plain numbers that every engine is given alike.
/// SI units, Y up.
namespace detent_stress {

enum class Solid : uint32_t {
  box,          ///< size: half extents
  sphere,       ///< size[0]: radius
  capsule,      ///< size[0]: radius, size[1]: half length of the core, along y
  icosahedron,  ///< size[0]: radius of its 12 vertices
};

enum class Role : uint32_t { fixed, kinematic, dynamic };

struct StageBody {
  Solid solid = Solid::box;
  Role role = Role::dynamic;
  double size[3] = {0.5, 0.5, 0.5};
  double position[3] = {0, 0, 0};     ///< of the centre of mass, m
  double rotation[4] = {0, 0, 0, 1};  ///< x, y, z, w
  double velocity[3] = {0, 0, 0};     ///< m/s
  double spin[3] = {0, 0, 0};         ///< rad/s, world
  double density = 1000;              ///< kg/m^3
  double mass = 0;                    ///< kg; 0: from the density
  double friction = 0.6;              ///< of any pair: the geometric mean of both
  double restitution = 0;             ///< of any pair: the larger of both
};

/// A ball joint: two points, one of each body, stay one.
struct StageJoint {
  uint32_t a = 0, b = 0;           ///< indices of bodies, of which one at least is dynamic
  double anchor_a[3] = {0, 0, 0};  ///< from A's centre of mass, m, A's axes
  double anchor_b[3] = {0, 0, 0};  ///< likewise of B
};

struct Stage {
  std::string name;
  std::vector<StageBody> bodies;  ///< those that do not move first
  std::vector<StageJoint> joints;
  bool collisions = true;  ///< whether any two bodies touch
  double gravity = 9.81;   ///< m/s^2, downwards
  double tick = 1.0 / 60;  ///< s
  double unit = 1;         ///< m: the scale of the scene, 1 as scenes.md has it
  uint32_t ticks = 600;
  bool sleeping = false;
};

/// How a body of a stage is at some tick, in the same numbers.
struct BodyState {
  double position[3] = {0, 0, 0};
  double rotation[4] = {0, 0, 0, 1};  ///< x, y, z, w
  double velocity[3] = {0, 0, 0};
  double spin[3] = {0, 0, 0};
};
using States = std::vector<BodyState>;
States states_at_start(const Stage& stage);
/// Where a point of a body is, m, world: given from its centre of mass, m, in its axes.
std::array<double, 3> point_of(const BodyState& state, const double (&point)[3]);

/// Every length and position times `factor`, and every speed (and with it the time scale) times its root, so that the
/// same motion is seen under the same gravity; the tick is scaled alike.
Stage scaled(const Stage& stage, double factor);
/// Everything moved by (distance, distance, distance): whole metres, below 2^24. Positions are rounded to 2^-28 m
/// first, so that the sum is exact; moved(stage, 0) is what a moved one is to be compared with.
Stage moved(const Stage& stage, double distance);
/// The same scene as another: what can move in a random order of creation, all of it turned about y by a random angle.
/// Seed 0 leaves it as it is.
Stage varied(const Stage& stage, uint64_t seed);

/// kg; of any role.
double mass_of(const StageBody& body);
/// Of the principal moments of inertia over the mass, about the body's axes, m^2.
std::array<double, 3> gyration_of(const StageBody& body);
/// m; of a ball about the centre of mass that holds the body.
double bounding_radius(const StageBody& body);
/// The vertices of an icosahedron of this circumradius, m.
std::vector<std::array<double, 3>> icosahedron_points(double radius);

}  // namespace detent_stress
