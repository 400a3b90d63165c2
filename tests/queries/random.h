#pragma once
#include <math.h>
#include <stdint.h>

#include "tests/queries/triple.h"
#include "tests/support/random.h"

namespace detent_queries {

class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}
  uint64_t next() { return detent_test::split_mix(state_); }
  double uniform(double low, double high) { return low + (high - low) * static_cast<double>(next() >> 11) * 0x1p-53; }
  double log_uniform(double low, double high) { return low * exp(uniform(0, log(high / low))); }
  uint32_t below(uint32_t count) { return static_cast<uint32_t>(((next() >> 32) * count) >> 32); }
  bool chance(double probability) { return uniform(0, 1) < probability; }
  double sign() { return chance(0.5) ? 1 : -1; }

  /// Uniform on the sphere (Marsaglia 1972).
  Triple direction() {
    for (;;) {
      const double a = uniform(-1, 1), b = uniform(-1, 1), s = a * a + b * b;
      if (s >= 1) continue;
      const double r = 2 * sqrt(1 - s);
      return {a * r, b * r, 1 - 2 * s};
    }
  }
  /// Of length 1, perpendicular to `axis`.
  Triple perpendicular(const Triple& axis) {
    for (;;) {
      const Triple v = cross(axis, direction());
      if (length(v) > 0.1 * length(axis)) return v * (1 / length(v));
    }
  }
  /// Uniform; x, y, z, w; each component a float.
  Rotation rotation() {
    for (;;) {
      Rotation q;
      double square = 0;
      for (double& component : q) {
        component = uniform(-1, 1);
        square += component * component;
      }
      if (square > 1 || square < 0.01) continue;
      for (double& component : q) component = to_float(component / sqrt(square));
      return q;
    }
  }

 private:
  uint64_t state_;
};

}  // namespace detent_queries
