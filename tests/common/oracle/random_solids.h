#pragma once
#include <stdint.h>

#include "tests/common/oracle/convex_solid.h"
#include "tests/common/support/random.h"

/// Random solids and poses for the tests of the oracles.
namespace detent_oracle {

class Dice {
 public:
  explicit Dice(uint64_t seed) : state_(seed) {}
  uint64_t bits() { return detent_test::split_mix(state_); }
  double between(double low, double high) { return low + (high - low) * static_cast<double>(bits() >> 11) * 0x1p-53; }
  int below(int count) { return static_cast<int>(bits() % static_cast<uint64_t>(count)); }
  bool coin() { return (bits() >> 63) != 0; }

  detent_queries::Triple direction() {
    for (;;) {
      const detent_queries::Triple v = {between(-1, 1), between(-1, 1), between(-1, 1)};
      const double size = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
      if (size > 0.1 && size < 1) return {v[0] / size, v[1] / size, v[2] / size};
    }
  }
  Arrow arrow(double size) {
    const detent_queries::Triple v = direction();
    return {v[0] * size, v[1] * size, v[2] * size};
  }
  std::array<double, 4> rotation() {
    for (;;) {
      const std::array<double, 4> q = {between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1)};
      const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
      if (square > 0.01 && square < 1) return q;
    }
  }

 private:
  uint64_t state_;
};

/// `count` points near an ellipsoid of these half axes; all of them extreme.
inline detent_queries::Solid random_hull(Dice& dice, int count, const detent_queries::Triple& axes) {
  detent_queries::Solid solid;
  solid.kind = detent_queries::Kind::hull;
  for (int i = 0; i < count; ++i) {
    const detent_queries::Triple v = dice.direction();
    solid.points.push_back({v[0] * axes[0], v[1] * axes[1], v[2] * axes[2]});
  }
  return solid;
}

/// A solid of about `size`, now and then a needle or a plate of 1:1000, now and then rounded.
inline detent_queries::Solid random_solid(Dice& dice, detent_queries::Kind kind, double size) {
  const auto length = [&dice, size] { return size * (dice.below(8) == 0 ? 1e-3 : dice.between(0.1, 1)); };
  detent_queries::Solid solid;
  if (kind == detent_queries::Kind::hull) {
    const int count = 8 + dice.below(40);
    const detent_queries::Triple axes = {length(), length(), length()};
    solid = random_hull(dice, count, axes);
  }
  solid.kind = kind;
  solid.radius = length();
  solid.half_length = length();
  solid.half_extents = {length(), length(), length()};
  if (kind == detent_queries::Kind::triangle) {
    const detent_queries::Triple axes = {length(), length(), length()};
    solid.points = random_hull(dice, 3, axes).points;
  }
  const bool roundable = kind != detent_queries::Kind::sphere && kind != detent_queries::Kind::capsule &&
                         kind != detent_queries::Kind::half_space;
  if (roundable && dice.below(3) == 0) solid.rounding = length() / 4;
  return solid;
}

}  // namespace detent_oracle
