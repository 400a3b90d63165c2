#pragma once
#include <detent/world.h>

/// A figure of boxes and capsules, connected by joints with limits. Its tests: tests/campaigns/stress/ragdoll_test.cpp.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace ragdoll {

inline constexpr uint32_t k_parts = 11, k_joints = 10;
inline constexpr double k_height = 1.8;  ///< m

/// The k_parts bodies and k_joints joints, in the order of the tables in ragdoll.cpp.
struct Ragdoll {
  BodyId part[k_parts] = {};
  JointId joint[k_joints] = {};
};

/// Makes a figure that stands on its feet in the x-y plane, with its arms stretched out along x and its face along z.
/// Errors: those of create_body and create_joint.
Status make(World& world, const Position& feet, Ragdoll& ragdoll);

/// Rotates the figure about its hips by the rotation vector `rotation_vector`, rad, and sets the velocity of all its
/// parts, m/s. Errors: bad_id, out_of_range.
Status throw_figure(World& world, const Ragdoll& ragdoll, const Vec3<Real>& rotation_vector,
                    const Vec3<Real>& linear_velocity);

}  // namespace ragdoll
}  // namespace DETENT_NAMESPACE
}  // namespace detent
