#pragma once
#include "ports/host/cook/cook_compound.h"
#include "tests/common/support/test.h"
#include "tests/unit/shape/terrains.h"

/// Small compounds for tests, and their cooked bytes.
namespace detent_compounds {

using Part = detent_cook::CompoundPart;
using Parts = std::vector<Part>;

inline Part ball(double x, double y, double z, double radius) { return {Part::Kind::ball, {{x, y, z}}, radius, 1}; }
inline Part capsule(detent_cook::Point a, detent_cook::Point b, double radius) {
  return {Part::Kind::capsule, {a, b}, radius, 1};
}
inline Part box(detent_cook::Point centre, detent_cook::Point half, double rounding = 0) {
  return {Part::Kind::hull, detent_cook::box_points(centre, half, {0, 0, 0, 1}), rounding, 1};
}

/// A base of 2 by 0.5 by 1 m with its underside at y = 0, and an upright of 0.5 by 1.5 by 1 m on its left end.
inline Parts letter_l() { return {box({0, 0.25, 0}, {1, 0.25, 0.5}), box({-0.75, 1.25, 0}, {0.25, 0.75, 0.5})}; }
/// A top of 2 by 0.1 by 2 m at y from 0.9 to 1 m, on four legs of 0.1 by 0.9 by 0.1 m at its corners.
inline Parts table() {
  Parts parts = {box({0, 0.95, 0}, {1, 0.05, 1})};
  for (const double x : {-0.95, 0.95}) {
    for (const double z : {-0.95, 0.95}) parts.push_back(box({x, 0.45, z}, {0.05, 0.45, 0.05}));
  }
  return parts;
}
/// Two balls of radius 0.5 m at x = -1 and 1 m, on a bar.
inline Parts dumbbell() { return {ball(-1, 0, 0, 0.5), ball(1, 0, 0, 0.5), capsule({-1, 0, 0}, {1, 0, 0}, 0.1)}; }
/// Three capsules at right angles that cross at the origin.
inline Parts jack(double half, double radius) {
  return {capsule({-half, 0, 0}, {half, 0, 0}, radius), capsule({0, -half, 0}, {0, half, 0}, radius),
          capsule({0, 0, -half}, {0, 0, half}, radius)};
}

inline detent_terrains::Bytes cooked(const Parts& parts) {
  const detent_cook::CompoundResult result = detent_cook::cook_compound(parts);
  EXPECT_EQ(result.reason, "");
  return detent_terrains::Bytes(result.bytes);
}

}  // namespace detent_compounds
