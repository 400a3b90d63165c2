#pragma once
#include <detent/world.h>

/// A figure of boxes and capsules, held together by joints with limits. Its tests: tests/stress/ragdoll_test.cpp.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace ragdoll {

inline constexpr uint32_t k_parts = 11, k_joints = 10;
inline constexpr double k_height = 1.8;  ///< m

/// Of k_parts and k_joints: the order of the table in ragdoll.cpp.
struct Ragdoll {
  BodyId part[k_parts] = {};
  JointId joint[k_joints] = {};
};

/// Stands on its feet, in the x-y plane, with its arms stretched out along x; its face looks along z.
/// Errors: as create_body and create_joint.
Status make(World& world, const Position& feet, Ragdoll& ragdoll);

/// Turns the figure about its hips by |turn| rad about the direction of `turn`, and lets it fly, m/s.
/// Errors: bad_id, out_of_range.
Status throw_figure(World& world, const Ragdoll& ragdoll, const Vec3<Real>& turn, const Vec3<Real>& velocity);

}  // namespace ragdoll
}  // namespace DETENT_NAMESPACE
}  // namespace detent
