#pragma once
#include "tests/campaigns/joint_fuzz/scene.h"

/// The energy of a scene and the gaps of its joints, computed in doubles from the world's poses and velocities.
namespace detent_joint_fuzz {

/// The pose and motion of a body.
struct State {
  Triple position = {};  ///< m
  Rotation rotation = {0, 0, 0, 1};
  Triple linear_velocity = {};   ///< m/s
  Triple angular_velocity = {};  ///< rad/s, world
};
using States = std::vector<State>;

/// A body's mass, kg, and moments of inertia about its own axes, kg m^2; 0 for a wall.
struct Inertia {
  double mass = 0;
  Triple moments = {};
};

/// Kinetic and potential energy, J; potential energy is 0 at y = 0. NaN if a state is not a number. `lag`: the time by
/// which the velocities are older than the positions, s.
double energy_of(const Scene& scene, const std::vector<Inertia>& inertia, const States& states, double lag = 0);
/// The energy that growth is compared with, J: the kinetic energy at the start, plus a tenth of the total weight times
/// the scene's extent. Always above 0.
double scale_of(const Scene& scene, const std::vector<Inertia>& inertia, const States& start);

/// The error of a joint.
struct Gap {
  double length = 0;  ///< m; for a distance joint the part beyond its limits
  double angle = 0;   ///< rad, between axes that should coincide
};
Gap gap_of(const SceneJoint& joint, const States& states);
/// The greatest over all joints.
Gap greatest_gap(const Scene& scene, const States& states);

/// An upper bound of the drives' power at these states, W: each force_max times the present rate, or times the motor's
/// speed if that is greater. Brakes, and springs at rest at the start, count as 0.
double power_max(const Scene& scene, const States& states);

}  // namespace detent_joint_fuzz
