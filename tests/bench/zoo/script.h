#pragma once
#include <array>
#include <memory>

#include "tests/campaigns/zoo/mechanics.h"

/// A scene of the zoo as plain data, for engines that know no type of the library's. Read by the library's own reader
/// of scenes into a world that is never stepped: the one description of what there is, and what plays the calls.
namespace detent_zoo {

/// As ShapeType has them; a height field is a mesh.
enum class Solid : uint32_t { sphere, capsule, box, cylinder, cone, hull, half_space, mesh };

/// A piece of a body, in its frame; sizes as Shape has them.
struct Part {
  Solid solid = Solid::sphere;
  double radius = 0, half_length = 0;  ///< m; along the part's y
  Vector half_extents;                 ///< m; of a hull and a mesh those of their bounds
  double rounding = 0;                 ///< m
  Vector position;                     ///< m
  Rotation rotation;                   ///< from the part's axes to the body's
  std::vector<Vector> points;          ///< of a hull or a mesh
  /// Of them: of a hull its faces, counter-clockwise from outside; of a mesh its triangles.
  std::vector<std::vector<uint32_t>> faces;
};

/// What a body is besides where it is.
struct Properties {
  std::vector<Part> parts;
  double friction = 0, restitution = 0, rolling_resistance = 0;
  bool damps = false;     ///< RestitutionRule::smaller
  double half_width = 0;  ///< m, the least; what rolling resistance is measured by. Of what has no width very large
  double linear_damping = 0, angular_damping = 0;  ///< 1/s
  uint32_t category = 1, mask = ~0u;
  int32_t group = 0;
  bool sensor = false;
};

/// What a joint is besides what it holds.
struct Ties {
  double friction_force = 0, friction_torque = 0;  ///< N, N m
  double break_force = 0, break_torque = 0;        ///< likewise; 0: never
  bool collide = false;
};

/// Of a pair, as the library has it.
double pair_friction(const Properties& a, const Properties& b);
double pair_restitution(const Properties& a, const Properties& b);
double pair_rolling_arm(const Properties& a, const Properties& b);  ///< m: torque over normal force
bool pair_touches(const Properties& a, const Properties& b);        ///< by their filters

/// Bodies and joints by numbers that are never given twice.
using Id = uint64_t;

class Script {
 public:
  virtual ~Script() = default;
  virtual uint32_t ticks() const = 0;
  /// What there is, without contacts.
  virtual Frame frame() const = 0;
  /// Those of the frame, in its order.
  virtual std::vector<Id> bodies() const = 0;
  virtual std::vector<Id> joints() const = 0;
  virtual Properties properties(Id body) const = 0;
  virtual Ties ties(Id joint) const = 0;
  virtual std::string body_name(Id body) const = 0;

  virtual bool calls_at(uint32_t tick) const = 0;
  /// Where the bodies of the frame are before the calls.
  virtual void place(const std::vector<BodyFrame>& bodies) = 0;
  /// The calls before that tick. Changes what there is, or says a problem.
  virtual void call(uint32_t tick, std::string& problem) = 0;
  /// It broke.
  virtual void remove_joint(Id joint) = 0;
};

/// Of the scene of that file, on that ground if it has one; or null and what is wrong.
std::unique_ptr<Script> open_script(const std::string& path, detent_test::Ground ground, std::string& problem);
/// Whether the scene of that file has a ground that can be replaced.
bool has_ground(const std::string& path);

}  // namespace detent_zoo
