#pragma once
#include "tests/joint_fuzz/scene.h"

/// The energy of a scene and the gaps of its joints, in doubles, from what a world says of its bodies.
namespace detent_joint_fuzz {

/// How a body is.
struct State {
  Triple position = {};  ///< m
  Rotation rotation = {0, 0, 0, 1};
  Triple velocity = {};  ///< m/s
  Triple spin = {};      ///< rad/s, world
};
using States = std::vector<State>;

/// What moves of a body: its mass, kg, and moments of inertia about its own axes, kg m^2; 0 of a wall.
struct Inertia {
  double mass = 0;
  Triple moments = {};
};

/// Kinetic, and potential above y = 0, J. Not a number if a state is none.
double energy_of(const Scene& scene, const std::vector<Inertia>& inertia, const States& states);
/// What a growth is measured by, J: the kinetic energy at the start, and a tenth of what the whole weighs times its
/// extent. Never quite 0.
double scale_of(const Scene& scene, const std::vector<Inertia>& inertia, const States& start);

/// By how much a joint gives way.
struct Gap {
  double length = 0;  ///< m; of a distance beyond its limits
  double angle = 0;   ///< rad, between axes that are to be one
};
Gap gap_of(const SceneJoint& joint, const States& states);
/// Of all joints.
Gap greatest_gap(const Scene& scene, const States& states);

/// The power that the drives of a scene can give at most at these states, W: each force_max times the rate, or the
/// motor's speed if that is more. Brakes, and springs that are at rest at the start, give none.
double power_max(const Scene& scene, const States& states);

}  // namespace detent_joint_fuzz
