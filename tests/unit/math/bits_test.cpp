#include "math/bits.h"

#include <detent/numbers.h>

#include "math/rotation.h"
#include "math/scaled.h"
#include "samples.h"
#include "tests/common/support/test.h"

/// A hash of the results of every kernel for the same arguments. It is equal on every target, compiler and optimisation
/// level.
namespace detent {
inline namespace DETENT_NAMESPACE {

struct Hash {
  uint64_t value = 0;
  void take(uint64_t bits) {
    value = (value ^ bits) * 0x9e3779b97f4a7c15u;
    value ^= value >> 29;
  }
  template <class Int, int frac>
  void take(Fixed<Int, frac> a) {
    take(static_cast<uint64_t>(int64_t{a.raw}));
  }
  void take(float a) { take(uint64_t{__builtin_bit_cast(uint32_t, a)}); }
  void take(double a) { take(__builtin_bit_cast(uint64_t, a)); }
  template <class T>
  void take(const Vec3<T>& v) {
    take(v.x);
    take(v.y);
    take(v.z);
  }
  void take(const Quat& q) {
    take(Vec3<Unit>{q.x, q.y, q.z});
    take(q.w);
  }
  void take(Angle angle) {
#if defined(DETENT_F64)
    take(angle.radians);
#else
    take(uint64_t{angle.raw});
#endif
  }
#if DETENT_FIXED
  void take(Scaled a) {
    take(static_cast<uint64_t>(int64_t{a.mantissa}));
    take(static_cast<uint64_t>(int64_t{a.exponent}));
  }
#endif
};

constexpr int k_count = 2000;

uint64_t hash_of_arithmetic() {
  Samples samples{91};
  Hash hash;
  for (int i = 0; i < k_count; ++i) {
    const Real a = samples.real(54);
    const Real b = samples.real(54);
    const Vec3<Real> v = samples.reals(60);
    const Vec3<Unit> n = samples.fractions();
    const Vec3<Unit> m = samples.fractions() * Unit(0.5);
    hash.take(a * b);
    hash.take(v * n.x);
    hash.take(dot(v, n));
    hash.take(cross(v, n));
    hash.take(dot(m, n));
    hash.take(cross(m, n));
    if (!(b == Real(0.0))) hash.take(divide(a, b));
    hash.take(scale_by_power(a, -static_cast<int>(samples.below(30))));
    hash.take(static_cast<uint64_t>(static_cast<int64_t>(exponent_above(a))));
    bool saturated = false;
    const Coord c = coord_advance(Coord(0.0), v.x, saturated);
    const Coord d = coord_advance(Coord(100.0), v.y, saturated);
    hash.take(c);
    hash.take(unit_difference(c, d, 17));
    hash.take(real_difference(c, d));
    const Scaled s = scaled_from(a);
    const Scaled t = scaled_from(v.z);
    hash.take(multiply(s, t));
    hash.take(add(s, t));
    if (!(t == Scaled(0.0))) hash.take(divide(s, t));
    hash.take(multiply(a, scaled_from(n.y), saturated));
    hash.take(uint64_t{saturated});
    hash.take(real_to_host(a));
  }
  return hash.value;
}

uint64_t hash_of_roots() {
  Samples samples{92};
  Hash hash;
  for (int i = 0; i < k_count; ++i) {
    const uint64_t word = samples.magnitude(64);
    hash.take(uint64_t{square_root_floor(word)});
    hash.take(square_root_nearest(Words128{word, samples.bits()}));
    hash.take(square_root(abs(samples.real())));
    const Vec3<Real> v = samples.reals(60);
    Vec3<Unit> n = {};
    Real size = {};
    if (normalise(v, n, size)) hash.take(n);
    hash.take(size);
    Unit unit_size = {};
    if (normalise(samples.fractions(), n, unit_size)) hash.take(n);
    hash.take(unit_size);
  }
  return hash.value;
}

uint64_t hash_of_rotations() {
  Samples samples{93};
  Hash hash;
  Quat q = k_identity;
  for (int i = 0; i < k_count; ++i) {
    const Vec3<Real> theta = samples.reals(36 + static_cast<int>(samples.below(20)));
    const Quat step = rotation_from_vector(theta);
    q = normalise(multiply(step, q));
    hash.take(step);
    hash.take(q);
    hash.take(rotation_vector_from(q));
    hash.take(rotate(q, samples.reals(60)));
    hash.take(rotate(q, samples.fractions() * Unit(0.5)));
    hash.take(matrix_from(q).column[2]);
    const Vec3<Unit> point = samples.uniforms();
    const Angle angle = arc_tangent(point.y, point.x);
    hash.take(angle);
    hash.take(radians(angle));
    hash.take(angle_from_radians(theta.x));
    Unit s, c;
    sine_cosine(angle_from_radians(theta.y), s, c);
    hash.take(s);
    hash.take(c);
  }
  return hash.value;
}

#if defined(DETENT_FX64)
constexpr uint64_t k_expected[] = {0xa5b54eaf9ff199d4u, 0x4a9767f6727f4da8u, 0x454d6f9f99189c48u};
#elif defined(DETENT_FX32)
constexpr uint64_t k_expected[] = {0xffaaab2cb15e4149u, 0x4a9767f6727f4da8u, 0x454d6f9f99189c48u};
#elif defined(DETENT_F32)
constexpr uint64_t k_expected[] = {0x80c44222e167b0d3u, 0xd8f19739a238f4e0u, 0xf758f219f90b6732u};
#else
constexpr uint64_t k_expected[] = {0xd010d3977ba6d4au, 0x7cce222f3fcd9c39u, 0xb957959f82643e26u};
#endif

DETENT_TEST(bits, arithmetic_is_the_same_on_every_target) { EXPECT_EQ(hash_of_arithmetic(), k_expected[0]); }
DETENT_TEST(bits, roots_are_the_same_on_every_target) { EXPECT_EQ(hash_of_roots(), k_expected[1]); }
DETENT_TEST(bits, rotations_are_the_same_on_every_target) { EXPECT_EQ(hash_of_rotations(), k_expected[2]); }

}  // namespace DETENT_NAMESPACE
}  // namespace detent
