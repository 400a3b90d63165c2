#include "math/rotation.h"

#include "base/cycle.h"

#if DETENT_FIXED
#include "math/rotation_integer.h"
#endif

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

constexpr Vec3<Unit> vector_part(const Quat& q) { return {q.x, q.y, q.z}; }
constexpr Quat quat_from(const Vec3<Unit>& v, Unit w) { return {v.x, v.y, v.z, w}; }

}  // namespace

#if DETENT_FIXED
namespace {

constexpr Quat32 raw_of(const Quat& q) { return {q.x.raw, q.y.raw, q.z.raw, q.w.raw}; }
constexpr Quat quat_of(const Quat32& q) {
  return {Unit::from_raw(q.x), Unit::from_raw(q.y), Unit::from_raw(q.z), Unit::from_raw(q.w)};
}
constexpr Vec3<Unit> units_of(const Vec32& v) {
  return {Unit::from_raw(v.x), Unit::from_raw(v.y), Unit::from_raw(v.z)};
}

[[maybe_unused]] Unit sum_of_products(Unit a, Unit b, Unit c, Unit d) {
  return unit_from_product(unit_product(a, b) + unit_product(c, d));
}
uint64_t square_of(const Quat& q) {
  return unit_product(q.x, q.x) + unit_product(q.y, q.y) + unit_product(q.z, q.z) + unit_product(q.w, q.w);
}

}  // namespace

Quat multiply(const Quat& a, const Quat& b) { return quat_of(multiply(raw_of(a), raw_of(b))); }

Quat normalise(const Quat& q) { return quat_of(normalise(raw_of(q))); }

Quat normalise_any(const Quat& q) {
  const uint64_t square = square_of(q);
  DETENT_VERIFY_RANGE(square >= uint64_t{1} << 58);
  const int half_shift = (64 - bit_length_64(square)) / 2;
  const int64_t inverse = reciprocal_root(static_cast<uint32_t>((square << (2 * half_shift)) >> 32));
  const int shift = 33 - half_shift;
  const auto scaled = [inverse, shift](Unit a) { return unit_from_raw(round_shift_64(a.raw * inverse, shift)); };
  return {scaled(q.x), scaled(q.y), scaled(q.z), scaled(q.w)};
}

bool normalise_input(const Quat& q, Quat& out) {
  Quat32 raw = raw_of(q);
  if (!normalise_input(raw)) return false;
  out = quat_of(raw);
  return true;
}

Vec3<Unit> rotate(const Quat& q, const Vec3<Unit>& v) {
  // v + 2 (w s + u x s), s = u x v
  const Vec3<Unit> u = vector_part(q);
  const Vec3<Unit> s = cross(u, v);
  const auto turned = [&q](Unit a, Unit b, Unit c, Unit d, Unit e, Unit f) {
    const uint64_t half = unit_product(q.w, b) + unit_product(c, d) - unit_product(e, f);
    return unit_from_product((static_cast<uint64_t>(int64_t{a.raw}) << k_unit_frac) + 2 * half);
  };
  return {turned(v.x, s.x, u.y, s.z, u.z, s.y), turned(v.y, s.y, u.z, s.x, u.x, s.z),
          turned(v.z, s.z, u.x, s.y, u.y, s.x)};
}

Vec3<Real> rotate(const Quat& q, const Vec3<Real>& v) {
  const Vec3<Unit> u = vector_part(q);
  const Vec3<Real> s = cross(u, v);
  const auto turned = [&q](Real a, Real b, Unit c, Real d, Unit e, Real f) {
    return a + Real::from_raw(Int128::narrow_sum<k_unit_frac - 1>(b.raw, q.w.raw, d.raw, c.raw, f.raw, -e.raw));
  };
  return {turned(v.x, s.x, u.y, s.z, u.z, s.y), turned(v.y, s.y, u.z, s.x, u.x, s.z),
          turned(v.z, s.z, u.x, s.y, u.y, s.x)};
}

Vec3<Real> rotate_inverse(const Quat& q, const Vec3<Real>& v) { return rotate(conjugate(q), v); }

Matrix3 matrix_from(const Quat& q) {
  const Matrix32 m = matrix_from(raw_of(q));
  return {{units_of(m.column[0]), units_of(m.column[1]), units_of(m.column[2])}};
}
#else
namespace {

constexpr Unit sum_of_products(Unit a, Unit b, Unit c, Unit d) { return a * b + c * d; }
constexpr Unit sum_of_products(Unit a, Unit b, Unit c, Unit d, Unit e, Unit f, Unit g, Unit h) {
  return a * b + c * d + e * f + g * h;
}
Unit square_of(const Quat& q) { return sum_of_products(q.x, q.x, q.y, q.y, q.z, q.z, q.w, q.w); }
Quat scaled(const Quat& q, Unit factor) { return {q.x * factor, q.y * factor, q.z * factor, q.w * factor}; }

}  // namespace

Quat multiply(const Quat& a, const Quat& b) {
  return {sum_of_products(a.w, b.x, a.x, b.w, a.y, b.z, -a.z, b.y),
          sum_of_products(a.w, b.y, -a.x, b.z, a.y, b.w, a.z, b.x),
          sum_of_products(a.w, b.z, a.x, b.y, -a.y, b.x, a.z, b.w),
          sum_of_products(a.w, b.w, -a.x, b.x, -a.y, b.y, -a.z, b.z)};
}

Quat normalise_any(const Quat& q) { return scaled(q, Unit(1) / square_root(square_of(q))); }

#if defined(DETENT_F32)
Quat normalise(const Quat& q) {
  const Unit d = square_of(q) - Unit(1);
  return scaled(q, Unit(1) - d * (Unit(0.5) - Unit(0.375) * d));
}
#else
Quat normalise(const Quat& q) { return normalise_any(q); }  // a series as in f32 would need five terms
#endif

bool normalise_input(const Quat& q, Quat& out) {
  constexpr Unit k_low = Unit(1.0 - 0x1p-10);
  constexpr Unit k_high = Unit(1.0 + 0x1p-10);
  const Unit square = square_of(q);
  if (!(k_low * k_low <= square && square <= k_high * k_high)) return false;
  out = normalise(normalise(q));
  return true;
}

Vec3<Unit> rotate(const Quat& q, const Vec3<Unit>& v) {
  const Vec3<Unit> u = vector_part(q);
  const Vec3<Unit> s = cross(u, v) * Unit(2);
  return v + s * q.w + cross(u, s);
}

Matrix3 matrix_from(const Quat& q) {
  const auto diagonal = [](Unit a, Unit b) { return Unit(1) - Unit(2) * (a * a + b * b); };
  const auto sum = [](Unit a, Unit b, Unit c, Unit d) { return Unit(2) * (a * b + c * d); };
  return {{{diagonal(q.y, q.z), sum(q.x, q.y, q.w, q.z), sum(q.x, q.z, -q.w, q.y)},
           {sum(q.x, q.y, -q.w, q.z), diagonal(q.x, q.z), sum(q.y, q.z, q.w, q.x)},
           {sum(q.x, q.z, q.w, q.y), sum(q.y, q.z, -q.w, q.x), diagonal(q.x, q.y)}}};
}
#endif

Vec3<Unit> rotate_inverse(const Quat& q, const Vec3<Unit>& v) { return rotate(conjugate(q), v); }

Quat multiply_about(const Quat& q, int axis, Unit sine, Unit cosine) {
#if DETENT_FIXED && defined(__OPTIMIZE_SIZE__)
  Unit part[3] = {0.0, 0.0, 0.0};
  part[axis] = sine;
  return multiply(q, Quat{part[0], part[1], part[2], cosine});
#else
  const Unit v[3] = {q.x, q.y, q.z};
  const int next = next_of_three(axis), last = previous_of_three(axis);
  Unit product[3];
  product[axis] = sum_of_products(v[axis], cosine, q.w, sine);
  product[next] = sum_of_products(v[next], cosine, v[last], sine);
  product[last] = sum_of_products(v[last], cosine, -v[next], sine);
  return {product[0], product[1], product[2], sum_of_products(q.w, cosine, -v[axis], sine)};
#endif
}

Quat rotation_about(const Vec3<Unit>& axis, Angle angle) {
  Unit sine;
  Unit cosine;
  sine_cosine_of_half(angle, sine, cosine);
  return quat_from(axis * sine, cosine);
}

#if !defined(DETENT_F64)
namespace {

/// The rotation by |theta| rad about theta, by a series. This costs less than a root and a sine, and in f32 the error
/// is small relative to the angle. Range: the components of theta are below k_series_angle_max.
Quat small_rotation(const Vec3<Real>& theta) {
  const Vec3<Unit> eightfold = unit_from_real(theta, -3);
  const HalfAngleSeries series = half_angle_series(dot(eightfold, eightfold));
  const Vec3<Real> v = theta * series.sine_ratio;
  return {unit_from_real(v.x, 0), unit_from_real(v.y, 0), unit_from_real(v.z, 0), series.cosine};
}

/// The rotation vector of q, rad, by a series. Range: the components of q's vector part are below 2^-5, w > 0. The
/// omitted terms are below 2^-31 of the result.
Vec3<Real> small_rotation_vector(const Quat& q) {
  const Vec3<Unit> v = {q.x, q.y, q.z}, v8 = scale_by_power(v, 3);
  const Unit s = dot(v8, v8);  // 64 |v|^2 < 3/16
  // 2 asin(|v|) / |v| = 2 (1 + |v|^2/6 + 3 |v|^4/40 + 15 |v|^6/336)
  const Unit more = Unit(1.0 / 384) * (s * (Unit(1.0) + Unit(9.0 / 1280) * (s * (Unit(1.0) + Unit(25.0 / 2688) * s))));
  const Vec3<Real> twice = real_from_unit(v, 1);
  return twice + twice * more;
}

template <class T>
constexpr bool all_below(const Vec3<T>& v, T limit) {
  return abs(v.x) < limit && abs(v.y) < limit && abs(v.z) < limit;
}

}  // namespace
#endif

Quat rotation_from_vector(const Vec3<Real>& theta) {
#if !defined(DETENT_F64)
  if (all_below(theta, k_series_angle_max)) return small_rotation(theta);
  Vec3<Unit> axis;
  Real angle;
  if (!normalise(theta, axis, angle)) return k_identity;  // does not occur: theta is not short
  Unit sine;
  Unit cosine;
  sine_cosine_of_half_radians(angle, sine, cosine);
  return quat_from(axis * sine, cosine);
#else
  const Real angle = length(theta);
  if (angle == 0) return k_identity;
  Unit sine;
  Unit cosine;
  sine_cosine_of_half_radians(angle, sine, cosine);
  return quat_from(theta * (sine / angle), cosine);
#endif
}

Vec3<Real> rotation_vector_from(const Quat& q) {
  const Quat p = q.w < Unit(0.0) ? Quat{-q.x, -q.y, -q.z, -q.w} : q;
#if !defined(DETENT_F64)
  if (all_below(vector_part(p), Unit(0.03125))) return small_rotation_vector(p);
#endif
  Vec3<Unit> axis;
  Unit sine;
  if (!normalise(vector_part(p), axis, sine)) return {Real(0.0), Real(0.0), Real(0.0)};
  const Real half = radians(arc_tangent(sine, p.w));
  return axis * (half + half);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
