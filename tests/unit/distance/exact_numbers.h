#pragma once
#include "tests/unit/distance/bodies_at.h"

/// Numbers that every configuration represents exactly, so that the digests of the answers are equal.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A random multiple of 1/256, from -most to most.
inline double exact_number(Samples& samples, int64_t most) {
  return static_cast<double>(static_cast<int64_t>(samples.below(static_cast<uint32_t>(2 * most))) - most) / 256;
}
inline Vector exact_vector(Samples& samples, int64_t most) {
  const double x = exact_number(samples, most), y = exact_number(samples, most), z = exact_number(samples, most);
  return {{x, y, z}};
}
/// A pose with the rotation (1, 2, 2, 4) / 5, in 20 bits, the first three components in any order.
inline Pose exact_pose(Samples& samples, const Vector& at) {
  constexpr double k_fifth = 209715.0 / 1048576, k_two_fifths = 419430.0 / 1048576, k_four_fifths = 838861.0 / 1048576;
  const uint32_t small = samples.below(3);
  Pose pose;
  EXPECT_OK(coord_from_host(at[0], pose.position.x));
  EXPECT_OK(coord_from_host(at[1], pose.position.y));
  EXPECT_OK(coord_from_host(at[2], pose.position.z));
  EXPECT_OK(unit_from_host(small == 0 ? k_fifth : k_two_fifths, pose.rotation.x));
  EXPECT_OK(unit_from_host(small == 1 ? k_fifth : k_two_fifths, pose.rotation.y));
  EXPECT_OK(unit_from_host(small == 2 ? k_fifth : k_two_fifths, pose.rotation.z));
  EXPECT_OK(unit_from_host(k_four_fifths, pose.rotation.w));
  return pose;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
