#pragma once
#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "tests/common/queries/triple.h"
#include "tests/common/support/random.h"

namespace detent_queries {

class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}
  /// As long as it lasts, what two bytes of the tape say, over and over.
  Random(uint64_t seed, const uint8_t* tape, size_t count) : state_(seed), tape_(tape), tape_left_(count) {}
  size_t tape_left() const { return tape_left_; }
  uint64_t next() { return tape_left_ != 0 ? next_of_tape() : detent_test::split_mix(state_); }
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
  uint64_t next_of_tape() {
    const uint64_t high = *tape_++;
    --tape_left_;
    if (tape_left_ == 0) return high * 0x0101010101010101u;
    const uint64_t low = *tape_++;
    --tape_left_;
    return (high << 8 | low) * 0x0001000100010001u;
  }

  uint64_t state_;
  const uint8_t* tape_ = nullptr;
  size_t tape_left_ = 0;
};

}  // namespace detent_queries
