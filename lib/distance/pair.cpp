#include "distance/pair.h"

#include "base/float_environment.h"
#include "math/arithmetic.h"
#include "math/float_bits.h"
#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

#if DETENT_FIXED
bool raw_from_real(const Vec3<Real>& v, Vec64& raw) {
  raw = {v.x.raw, v.y.raw, v.z.raw};
  return true;
}

Real real_from_raw(int64_t raw) { return Real::from_raw(raw); }

namespace {

bool quat_bits(const Quat& q, Quat32& raw) {
  raw = {q.x.raw, q.y.raw, q.z.raw, q.w.raw};
  return true;
}

bool unit_bits(const Vec3<Unit>& v, Vec32& raw) {
  raw = {v.x.raw, v.y.raw, v.z.raw};
  return true;
}

}  // namespace

Vec3<Unit> units_from_raw(const Vec32& v) { return {Unit::from_raw(v.x), Unit::from_raw(v.y), Unit::from_raw(v.z)}; }
#else
bool raw_from_real(const Vec3<Real>& v, Vec64& raw) {
  bool out_of_range = false;
  raw = {integer_from_float(v.x, k_metre_bits, out_of_range), integer_from_float(v.y, k_metre_bits, out_of_range),
         integer_from_float(v.z, k_metre_bits, out_of_range)};
  return !out_of_range;
}

Real real_from_raw(int64_t raw) { return float_from_integer<Real>(raw, -k_metre_bits); }

namespace {

int32_t component_bits(Unit a, bool& out_of_range) {
  const int64_t bits = integer_from_float(a, 30, out_of_range);
  out_of_range = out_of_range || bits != static_cast<int32_t>(bits);
  return static_cast<int32_t>(bits);
}

bool quat_bits(const Quat& q, Quat32& raw) {
  bool out_of_range = false;
  const auto component = [&](Unit a) { return component_bits(a, out_of_range); };
  raw = {component(q.x), component(q.y), component(q.z), component(q.w)};
  return !out_of_range;
}

bool unit_bits(const Vec3<Unit>& v, Vec32& raw) {
  bool out_of_range = false;
  const auto component = [&](Unit a) { return component_bits(a, out_of_range); };
  raw = {component(v.x), component(v.y), component(v.z)};
  return !out_of_range;
}

}  // namespace

Vec3<Unit> units_from_raw(const Vec32& v) {
  return {float_from_integer<Unit>(v.x, -30), float_from_integer<Unit>(v.y, -30), float_from_integer<Unit>(v.z, -30)};
}
#endif

bool raw_from_quat(const Quat& q, Quat32& raw) {
  if (!quat_bits(q, raw)) return false;
  const uint64_t square = static_cast<uint64_t>(int64_t{raw.x} * raw.x) +
                          static_cast<uint64_t>(int64_t{raw.y} * raw.y) +
                          static_cast<uint64_t>(int64_t{raw.z} * raw.z) + static_cast<uint64_t>(int64_t{raw.w} * raw.w);
  // Rotations that the library computed have a length of 1 within 2^-29, and are not normalised again.
  if (square - ((uint64_t{1} << 60) - (uint64_t{1} << 32)) <= uint64_t{1} << 33) return true;
  return normalise_input(raw);
}

bool raw_from_direction(const Vec3<Unit>& v, Vec32& raw) {
  Vec32 bits;
  if (!unit_bits(v, bits) || is_zero(bits)) return false;
  raw = unit_vector_raw(scaled_to_30_bits(bits));
  return true;
}

namespace {

/// Keeps the leading `bits` bits of a number >= 0 and clears the others.
int64_t truncated(int64_t value, int bits) {
  const int drop = bit_length_64(static_cast<uint64_t>(value)) - bits;
  return drop <= 0 ? value : (value >> drop) << drop;
}

#if defined(DETENT_F64)
int64_t difference_of(Coord a, Coord b) {
  const FloatEnvironment environment;  // for a - b, which is the only floating-point operation here
  bool saturated = false;
  return integer_from_float(a - b, k_metre_bits, saturated);
}
bool is_finite(Coord a) { return float_parts(a).finite; }
#else
int64_t difference_of(Coord a, Coord b) {
  constexpr int k_shift = k_metre_bits - Coord::k_frac;
  const int64_t difference = subtract_wrapped(a.raw, b.raw);
  constexpr int64_t k_limit = INT64_MAX >> k_shift;
  if (a.raw < b.raw) {  // a wrapped difference has the wrong sign
    return difference >= 0 || difference < -k_limit ? -INT64_MAX : difference * (int64_t{1} << k_shift);
  }
  return difference < 0 || difference > k_limit ? INT64_MAX : difference << k_shift;
}
bool is_finite(Coord) { return true; }
#endif

}  // namespace

int64_t length_above(const Vec64& v) {
  const Int128 square = dot(v, v);
  const uint64_t root = square_root_nearest(Words128{static_cast<uint64_t>(square.high_word()), square.low_word()});
  return root >= static_cast<uint64_t>(INT64_MAX) ? INT64_MAX : static_cast<int64_t>(root) + 1;
}

int64_t length_bound(const Vec64& v) {
  const int length = bit_length_64(magnitude_64(v.x) | magnitude_64(v.y) | magnitude_64(v.z));
  const int n = length > 29 ? length - 29 : 0;
  const Vec32 head = round_shift(v, n);
  const int64_t bound = int64_t{square_root_bound(static_cast<uint64_t>(dot(head, head)))} + 2;
  return n > 31 ? INT64_MAX : bound << n;
}

int64_t raw_from_block(int64_t ulps, int exponent) {
  const int n = exponent + k_metre_bits - 30;
  if (n < 31 && ulps == static_cast<int32_t>(ulps)) return ulps * (int64_t{1} << n);
  const int64_t limit = INT64_MAX >> n;
  return ulps > limit ? INT64_MAX : ulps < -limit ? -INT64_MAX : ulps * (int64_t{1} << n);
}

Vec3<Real> surface_point(const Vec32& core, int exponent, const Vec32& normal, int64_t radius) {
  const auto component = [&](int64_t at, int32_t n) {
    const int64_t raw = raw_from_block(at, exponent);
    if (radius == 0) return real_from_raw(raw);
    return real_from_raw(saturated_sum(raw, Int128::product_narrow(radius, n).round_shift(30)));
  };
  return {component(core.x, normal.x), component(core.y, normal.y), component(core.z, normal.z)};
}

Vec3<Real> half_space_point(const Vec64& offset, const Vec32& on_other, int exponent, const Vec32& up, int32_t gap) {
  const auto component = [&](int64_t from, int64_t at, int32_t n) {
    const int64_t core = raw_from_block(at - ((int64_t{n} * gap + (int64_t{1} << 29)) >> 30), exponent);
    return real_from_raw(saturated_sum(from, core));
  };
  return {component(offset.x, on_other.x, up.x), component(offset.y, on_other.y, up.y),
          component(offset.z, on_other.z, up.z)};
}

Vec32 scaled_vector(const Vec32& v, int64_t length) {
  return round_shift(Vec64{v.x * length, v.y * length, v.z * length}, 30);
}

int raw_exponent_above(int64_t raw) {
  const int e = bit_length_64(static_cast<uint64_t>(raw)) - k_metre_bits;
  return e < -14 ? -14 : e;
}

Vec64 component_along(const Vec64& v, const Vec32& n) {
  const int64_t along = dot(v, n).round_shift(30);
  const auto component = [along](int32_t a) { return Int128::product_narrow(along, a).round_shift(30); };
  return {component(n.x), component(n.y), component(n.z)};
}

int64_t raw_core_radius(const Convex& convex) {
  return int64_t{convex.core_radius} << (k_metre_bits - 30 + convex.exponent);
}
int64_t raw_radius(const Convex& convex) {
  return int64_t{convex.radius} << (k_metre_bits - 30 + convex.radius_exponent);
}

bool raw_difference(const Position& a, const Position& b, Vec64& raw) {
  if (!is_finite(a.x) || !is_finite(a.y) || !is_finite(a.z)) return false;
  if (!is_finite(b.x) || !is_finite(b.y) || !is_finite(b.z)) return false;
  // Clamped a little below INT64_MAX, so that the later rounding to ulps never overflows.
  constexpr int64_t k_limit = INT64_MAX - (int64_t{1} << 36);
  const auto component = [](Coord p, Coord q) {
    const int64_t difference = difference_of(p, q);
    return difference > k_limit ? k_limit : difference < -k_limit ? -k_limit : difference;
  };
  raw = {component(a.x, b.x), component(a.y, b.y), component(a.z, b.z)};
  return true;
}

#if DETENT_FIXED
Real real_from_fraction(Fraction fraction) { return Real::from_raw(fraction.raw >> (Fraction::k_frac - k_metre_bits)); }
#else
Real real_from_fraction(Fraction fraction) {
  constexpr int k_bits = FloatFormat<Real>::k_fraction_bits + 1;
  return float_from_integer<Real>(truncated(fraction.raw, k_bits), -Fraction::k_frac);
}
#endif

double fraction_to_host(Fraction fraction) {
  return float_from_integer<double>(truncated(fraction.raw, 53), -Fraction::k_frac);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
