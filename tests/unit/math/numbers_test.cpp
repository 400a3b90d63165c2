#include <algorithm>

#include "math/rotation.h"
#include "math/scaled.h"
#include "oracle.h"
#include "samples.h"
#include "tests/common/support/test.h"

/// Compares every kernel with MPFR, at regular intervals of its domain and at its edges. Kernels of one 32-bit argument
/// are tested for all arguments in sweep_test.cpp. The bounds of the other inexact kernels are the largest errors found
/// here plus a margin; they are not derived.
namespace detent {
inline namespace DETENT_NAMESPACE {

namespace oracle = detent_oracle;
using oracle::Line;

// fx32 computes the bits of fx64.
constexpr int k_count = k_config == Config::fx32 ? 5000 : 100000;
constexpr const char* k_strided = "strided";
[[maybe_unused]] constexpr const char* k_nearest = "to nearest, ties up";

[[maybe_unused]] Big turns(int64_t phase, int exponent) {  // phase 2^exponent turns, in rad
  return Big::scaled(phase, exponent + 1) * Big::pi();
}

Big to_radians([[maybe_unused]] Angle angle) {
#if defined(DETENT_F64)
  return big(angle.radians);
#else
  return turns(angle.raw, -32);
#endif
}

Angle any_turn(Samples& samples) {
#if defined(DETENT_F64)
  return {static_cast<double>(samples.integer(60)) * 0x1p-43};
#else
  return {static_cast<uint32_t>(samples.below(4) == 0 ? samples.integer(32) : static_cast<int64_t>(samples.bits()))};
#endif
}

std::string show(Angle angle) {
#if defined(DETENT_F64)
  return show(angle.radians);
#else
  return oracle::format("%u", angle.raw);
#endif
}
std::string show(const Quat& q) { return show(Vec3<Unit>{q.x, q.y, q.z}) + " " + show(q.w); }

Quat any_rotation(Samples& samples) {
  for (;;) {
    Quat q = {samples.uniform(), samples.uniform(), samples.uniform(), samples.uniform()};
    const Big square =
        oracle::dot(big(Vec3<Unit>{q.x, q.y, q.z}), big(Vec3<Unit>{q.x, q.y, q.z})) + big(q.w) * big(q.w);
    if (square.number() < 0.3 || square.number() > 1) continue;
    return normalise(normalise_any(q));
  }
}

Big norm(const Quat& q) {
  const Big3 v = big(Vec3<Unit>{q.x, q.y, q.z});
  return oracle::root(oracle::dot(v, v) + big(q.w) * big(q.w));
}

/// q v q* by the exact formula, for a q of any length near 1.
Big3 turned(const Quat& q, const Big3& v) {
  const Big3 u = big(Vec3<Unit>{q.x, q.y, q.z});
  const Big3 s = oracle::cross(u, v);
  const Big3 t = oracle::cross(u, s);
  const Big w = big(q.w);
  const Big two(2.0);
  return {v.x + two * (w * s.x + t.x), v.y + two * (w * s.y + t.y), v.z + two * (w * s.z + t.z)};
}

#if DETENT_FIXED
constexpr int k_real_step = -46;

DETENT_TEST(numbers, products_are_rounded_to_nearest) {
  Line unit{k_config_name, 0, "Unit x Unit", "product < 2", k_nearest, "2^-30"};
  Line mixed{k_config_name, 1, "Real x Unit", "product < 2^17", k_nearest, "2^-46"};
  Line real{k_config_name, 2, "Real x Real", "product < 2^17", k_nearest, "2^-46"};
  Line dots{k_config_name, 3, "dot(Real, Unit)", "result < 2^17", k_nearest, "2^-46"};
  Line unit_dots{k_config_name, 4, "dot(Unit, Unit)", "result < 2", k_nearest, "2^-30"};
  Line crosses{k_config_name, 5, "cross(Real, Unit)", "result < 2^17", k_nearest, "2^-46"};
  Samples samples{10};
  for (int i = 0; i < k_count; ++i) {
    const Unit a = samples.fraction();
    const Unit b = samples.unit();
    unit.take(oracle::distance(big(a * b), big(a) * big(b), k_unit_step), [&] { return show(a) + " " + show(b); });
    const Real r = samples.real(62);
    mixed.take(oracle::distance(big(r * b), big(r) * big(b), k_real_step), [&] { return show(r) + " " + show(b); });
    const Real p = samples.real(54);
    const Real q = samples.real(54);
    real.take(oracle::distance(big(p * q), big(p) * big(q), k_real_step), [&] { return show(p) + " " + show(q); });
    const Vec3<Real> v = samples.reals(60);
    const Vec3<Unit> n = {samples.unit(), samples.unit(), samples.unit()};
    dots.take(oracle::distance(big(dot(v, n)), oracle::dot(big(v), big(n)), k_real_step),
              [&] { return show(v) + " . " + show(n); });
    crosses.take(oracle::distance(big(cross(v, n)), oracle::cross(big(v), big(n)), k_real_step),
                 [&] { return show(v) + " x " + show(n); });
    crosses.take(oracle::distance(big(cross(n, v)), oracle::cross(big(n), big(v)), k_real_step),
                 [&] { return show(n) + " x " + show(v); });
    const Vec3<Unit> m = samples.fractions() * Unit(0.5);
    unit_dots.take(oracle::distance(big(dot(m, samples.fractions() * Unit(0.0) + n * Unit(0.5))),
                                    oracle::dot(big(m), big(n * Unit(0.5))), k_unit_step),
                   [&] { return show(m) + " . " + show(n); });
  }
  for (Line* line : {&unit, &mixed, &real, &dots, &unit_dots, &crosses}) line->finish(0.5, k_strided);
}

DETENT_TEST(numbers, quotients_are_rounded_to_nearest) {
  Line real{k_config_name, 10, "divide(Real, Real)", "quotient < 2^17", k_nearest, "2^-46"};
  Line inverse{k_config_name, 11, "reciprocal(Real)", "size > 2^-17", k_nearest, "2^-46"};
  Line unit{k_config_name, 12, "divide(Unit, Unit)", "quotient < 2", k_nearest, "2^-30"};
  Samples samples{11};
  for (int i = 0; i < k_count; ++i) {
    const Real a = samples.real();
    const Real b = samples.real();
    if (b.raw != 0 && exponent_above(a) - exponent_above(b) < 16) {
      real.take(oracle::distance(big(divide(a, b)), big(a) / big(b), k_real_step),
                [&] { return show(a) + " " + show(b); });
    }
    if (exponent_above(b) > -16) {
      inverse.take(oracle::distance(big(reciprocal(b)), Big(1.0) / big(b), k_real_step), [&] { return show(b); });
    }
    const Unit c = samples.unit();
    const Unit d = samples.unit();
    if (d.raw != 0 && std::abs(big(c).number()) < 1.99 * std::abs(big(d).number())) {
      unit.take(oracle::distance(big(divide(c, d)), big(c) / big(d), k_unit_step),
                [&] { return show(c) + " " + show(d); });
    }
  }
  for (Line* line : {&real, &inverse, &unit}) line->finish(0.5, k_strided);
}

DETENT_TEST(numbers, scaled_results_have_31_significant_bits) {
  const char* rounding = "to nearest, ties away";
  Line product{k_config_name,        20, "multiply(Scaled, Scaled)", "result in [2^-226, 2^286]", rounding,
               "2^-30 of the result"};
  Line quotient{k_config_name, 21, "divide(Scaled, Scaled)", "the same", rounding, "2^-30 of the result"};
  Line sum{k_config_name, 22, "add(Scaled, Scaled)", "all", rounding, "2^-30 of the result"};
  Line root{k_config_name, 23, "square_root(Scaled)", "a >= 0", rounding, "2^-30 of the result"};
  Line conversion{k_config_name, 24, "scaled_from(Real)", "all", rounding, "2^-30 of the result"};
  Line real{k_config_name, 25, "multiply(Real, Scaled)", "result < 2^17", k_nearest, "2^-46"};
  Line back{k_config_name, 26, "to_unit(Scaled)", "size < 2", k_nearest, "2^-30"};
  Samples samples{12};
  const auto any = [&samples](int exponent_range) {
    return scaled_from_parts(
        samples.below(2) == 0, samples.magnitude(31),
        static_cast<int>(samples.below(static_cast<uint32_t>(2 * exponent_range))) - exponent_range);
  };
  const auto relative = [](const Big& got, const Big& truth) {
    return truth.number() == 0 ? (got.number() == 0 ? 0.0 : 1e9) : oracle::distance(got / truth, Big(1.0), -30);
  };
  const auto show_scaled = [](Scaled a) { return oracle::format("%d 2^%d", a.mantissa, a.exponent); };
  for (int i = 0; i < k_count; ++i) {
    const Scaled a = any(60);
    const Scaled b = any(60);
    const auto both = [&] { return show_scaled(a) + ", " + show_scaled(b); };
    product.take(relative(big(multiply(a, b)), big(a) * big(b)), both);
    if (b.mantissa != 0) quotient.take(relative(big(divide(a, b)), big(a) / big(b)), both);
    Scaled near = any(40);
    near.exponent = a.exponent + static_cast<int32_t>(samples.below(80)) - 40;
    if (near.mantissa == 0) near.exponent = 0;
    sum.take(relative(big(add(a, near)), big(a) + big(near)),
             [&] { return show_scaled(a) + ", " + show_scaled(near); });
    const Scaled positive = a.mantissa < 0 ? negate(a) : a;
    root.take(relative(big(square_root(positive)), oracle::root(big(positive))), [&] { return show_scaled(positive); });
    const Real r = samples.real();
    conversion.take(relative(big(scaled_from(r)), big(r)), [&] { return show(r); });
    Scaled fraction = any(1);
    fraction.exponent = fraction.mantissa == 0 ? 0 : -31 - static_cast<int32_t>(samples.below(50));
    const auto pair = [&] { return show(r) + ", " + show_scaled(fraction); };
    real.take(oracle::distance(big(multiply(r, fraction)), big(r) * big(fraction), k_real_step), pair);
    bool saturated = false;
    const Real checked = multiply(r, a, saturated);
    const Big exact = big(r) * big(a);
    if (saturated)
      EXPECT_GE(std::abs(exact.number()), 131071.9) << show(r) << ", " << show_scaled(a);
    else
      real.take(oracle::distance(big(checked), exact, k_real_step), [&] { return show(r) + ", " + show_scaled(a); });
    back.take(oracle::distance(big(to_unit(fraction)), big(fraction), k_unit_step),
              [&] { return show_scaled(fraction); });
  }
  for (Line* line : {&product, &quotient, &sum, &root, &conversion}) line->finish(0.5, k_strided);
  real.finish(0.5, k_strided);
  back.finish(0.5, k_strided);
}

DETENT_TEST(numbers, roots_are_rounded_to_nearest) {
  Line real{k_config_name, 30, "square_root(Real)", "a >= 0", "to nearest", "2^-46"};
  Line lengths{k_config_name, 31, "length(Real)", "result < 2^17", "to nearest", "2^-46"};
  Line unit_lengths{k_config_name, 32, "length(Unit)", "result < 2", "to nearest", "2^-30"};
  Samples samples{13};
  for (int i = 0; i < k_count; ++i) {
    const Real a = Real::from_raw(static_cast<int64_t>(samples.magnitude(63)));
    real.take(oracle::distance(big(square_root(a)), oracle::root(big(a)), k_real_step), [&] { return show(a); });
    const Vec3<Real> v = samples.reals(62);
    lengths.take(oracle::distance(big(length(v)), oracle::length(big(v)), k_real_step), [&] { return show(v); });
    const Vec3<Unit> n = samples.fractions();
    unit_lengths.take(oracle::distance(big(length(n)), oracle::length(big(n)), k_unit_step), [&] { return show(n); });
  }
  for (Line* line : {&real, &lengths, &unit_lengths}) line->finish(0.5, k_strided);
}
#endif

DETENT_TEST(numbers, directions_are_unit_and_point_along_the_vector) {
  Line direction{k_config_name, 40, "normalise(Real)", "v != 0", "component of n", "step"};
  Line one{k_config_name, 41, "normalise(Real)", "v != 0", "length of n", "step"};
  Line unit_direction{k_config_name, 42, "normalise(Unit)", "v != 0", "component of n", "step"};
  Samples samples{14};
  for (int i = 0; i < k_count; ++i) {
    const Vec3<Real> v = samples.reals(62);
    Vec3<Unit> n = {};
    Real size = {};
    const bool is_zero = v == Vec3<Real>{Real(0.0), Real(0.0), Real(0.0)};
    EXPECT_NE(normalise(v, n, size), is_zero);
    if (!is_zero) {
      const Big true_size = oracle::length(big(v));
      const Big3 truth = {big(v.x) / true_size, big(v.y) / true_size, big(v.z) / true_size};
      direction.take(oracle::distance(big(n), truth, k_unit_step), [&] { return show(v); });
      one.take(oracle::distance(oracle::length(big(n)), Big(1.0), k_unit_step), [&] { return show(v); });
#if DETENT_FIXED
      EXPECT_EQ(size, length(v));
#endif
    }
    const Vec3<Unit> u = i % 2 == 0 ? samples.fractions() : samples.uniforms();
    Unit unit_size = {};
    if (normalise(u, n, unit_size)) {
      const Big true_size = oracle::length(big(u));
      const Big3 truth = {big(u.x) / true_size, big(u.y) / true_size, big(u.z) / true_size};
      unit_direction.take(oracle::distance(big(n), truth, k_unit_step), [&] { return show(u); });
    }
  }
  direction.finish(k_normalise_error, k_strided);
  unit_direction.finish(k_normalise_error, k_strided);
  one.finish(k_normalise_length_error, k_strided);
}

DETENT_TEST(numbers, sines_and_cosines_are_within_their_bound) {
  Line whole{k_config_name,
             51,
             "sine_cosine",
             DETENT_FIXED || k_config == Config::f32 ? "all turns" : "angle < 2^17 rad",
             "to nearest, plus the kernel's",
             "step"};
  Line half{k_config_name,
            52,
            "sine_cosine_of_half",
            DETENT_FIXED || k_config == Config::f32 ? "all turns" : "angle < 2^17 rad",
            "to nearest, plus the kernel's",
            "step"};
  Samples samples{15};
  for (int i = 0; i < k_count; ++i) {
    const Angle angle = any_turn(samples);
    Unit s;
    Unit c;
    const auto take = [&](Line& line, const Big& radians) {
      line.take(std::max(oracle::distance(big(s), oracle::sine(radians), k_unit_step),
                         oracle::distance(big(c), oracle::cosine(radians), k_unit_step)),
                [&] { return show(angle); });
    };
    sine_cosine(angle, s, c);
    take(whole, to_radians(angle));
    sine_cosine_of_half(angle, s, c);
#if defined(DETENT_F64)
    take(half, big(angle.radians) * Big(0.5));
#else
    take(half, turns(static_cast<int32_t>(angle.raw), -33));
#endif
  }
  whole.finish(k_sine_error, k_strided);
  half.finish(k_sine_error, k_strided);
}

DETENT_TEST(numbers, arc_tangents_are_within_their_bound) {
  Line line{k_config_name,
            53,
            "arc_tangent",
            "coordinates < 2",
            "to nearest, plus the kernel's",
            k_config == Config::f64 ? "2^-53 rad" : "2^-32 turns"};
  Samples samples{16};
  for (int i = 0; i < k_count; ++i) {
    const Unit y = i % 2 == 0 ? samples.unit() : samples.uniform();
    const Unit x = i % 4 < 2 ? samples.unit() : samples.uniform();
    if (y == Unit(0.0) && x == Unit(0.0)) continue;
    const Angle angle = arc_tangent(y, x);
    const Big truth = oracle::arc_tangent(big(y), big(x));
#if defined(DETENT_F64)
    line.take(oracle::distance(big(angle.radians), truth, -53), [&] { return show(y) + " " + show(x); });
#else
    const Big true_turns = truth / (Big(2.0) * Big::pi());
    const Big signed_turns = Big::scaled(static_cast<int32_t>(angle.raw), -32);
    const double error = oracle::distance(signed_turns, true_turns, -32);
    line.take(std::min(error, std::abs(4294967296.0 - error)), [&] { return show(y) + " " + show(x); });
#endif
  }
  line.finish(k_arc_tangent_error, k_strided);
}

#if !defined(DETENT_F64)
DETENT_TEST(numbers, radians_and_turns_convert_to_nearest) {
  Line to_turn{k_config_name, 54, "angle_from_radians", "angle < 2^17", "to nearest", "2^-32 turns"};
  Line to_real{k_config_name, 55, "radians", "all turns", "to nearest", DETENT_FIXED ? "2^-46" : "2^-24 of the result"};
  Samples samples{17};
  for (int i = 0; i < k_count; ++i) {
    const Real angle = samples.real(62);
    Big true_turns = big(angle) / (Big(2.0) * Big::pi());
    Big whole;
    mpfr_floor(whole.value, true_turns.value);
    const double error = oracle::distance(Big::scaled(angle_from_radians(angle).raw, -32), true_turns - whole, -32);
    to_turn.take(std::min(error, std::abs(4294967296.0 - error)), [&] { return show(angle); });
    const int32_t raw = static_cast<int32_t>(samples.integer(31));
    const Big truth = turns(raw, -32);
    const Real got = radians({static_cast<uint32_t>(raw)});
    if (raw == 0) continue;
    to_real.take(
        DETENT_FIXED ? oracle::distance(big(got), truth, -46) : oracle::distance(big(got) / truth, Big(1.0), -24),
        [&] { return oracle::format("%d", raw); });
  }
  to_turn.finish(0.50002, k_strided);
  to_real.finish(DETENT_FIXED ? 0.5001 : 1.001, k_strided);
}
#endif

DETENT_TEST(numbers, quaternions_keep_their_length_and_rotate_within_the_bound) {
  Line product{k_config_name, 60, "multiply(Quat, Quat)", "unit quaternions", "component", "step"};
  Line near_one{k_config_name, 61, "normalise(Quat)", "1 + (-1 to 1) 2^-11", "length", "step"};
  Line any{k_config_name, 62, "normalise_any(Quat)", "length in [1/2, 1]", "length", "step"};
  Line unit{k_config_name, 63, "rotate(Unit)", "length <= 1", "component", "step"};
  Line real{k_config_name,   64,          "rotate(Real)",
            "length < 2^16", "component", DETENT_FIXED ? "2^-46" : "step of the length"};
  Line matrix{k_config_name, 65, "matrix_from", "unit quaternions", "entry", "step"};
  Line applied{k_config_name, 66, "multiply(Matrix3, Unit)", "length <= 1", "component", "step"};
  Samples samples{18};
  for (int i = 0; i < k_count / 4; ++i) {
    const Quat a = any_rotation(samples);
    const Quat b = any_rotation(samples);
    const auto both = [&] { return show(a) + ", " + show(b); };
    const Quat c = multiply(a, b);
    const Big3 av = big(Vec3<Unit>{a.x, a.y, a.z});
    const Big3 bv = big(Vec3<Unit>{b.x, b.y, b.z});
    const Big3 t = oracle::cross(av, bv);
    const Big aw = big(a.w);
    const Big bw = big(b.w);
    product.take(std::max(oracle::distance(
                              big(Vec3<Unit>{c.x, c.y, c.z}),
                              {aw * bv.x + bw * av.x + t.x, aw * bv.y + bw * av.y + t.y, aw * bv.z + bw * av.z + t.z},
                              k_unit_step),
                          oracle::distance(big(c.w), aw * bw - oracle::dot(av, bv), k_unit_step)),
                 both);
    const Unit stretch = Unit(1.0) + scale_by_power(samples.fraction(), -11) * Unit(0.99);
    const Quat off = {a.x * stretch, a.y * stretch, a.z * stretch, a.w * stretch};
    near_one.take(oracle::distance(norm(normalise(off)), Big(1.0), k_unit_step), [&] { return show(off); });
    const Unit shrink = Unit(0.75) + samples.fraction() * Unit(0.2499);
    const Quat small = {a.x * shrink, a.y * shrink, a.z * shrink, a.w * shrink};
    any.take(oracle::distance(norm(normalise_any(small)), Big(1.0), k_unit_step), [&] { return show(small); });
    const Vec3<Unit> v = samples.fractions() * Unit(0.57);
    const auto with_vector = [&] { return show(a) + ", " + show(v); };
    unit.take(oracle::distance(big(rotate(a, v)), turned(a, big(v)), k_unit_step), with_vector);
    unit.take(oracle::distance(big(rotate_inverse(a, v)), turned(conjugate(a), big(v)), k_unit_step), with_vector);
    const Vec3<Real> r = samples.reals(61);
    const int step = DETENT_FIXED ? -46 : k_unit_step + exponent_above(length(r));
    real.take(oracle::distance(big(rotate(a, r)), turned(a, big(r)), step), [&] { return show(a) + ", " + show(r); });
    const Matrix3 m = matrix_from(a);
    const Vec3<Unit> axes[] = {
        {Unit(1.0), Unit(0.0), Unit(0.0)}, {Unit(0.0), Unit(1.0), Unit(0.0)}, {Unit(0.0), Unit(0.0), Unit(1.0)}};
    for (int axis = 0; axis < 3; ++axis) {
      matrix.take(oracle::distance(big(m.column[axis]), turned(a, big(axes[axis])), k_unit_step),
                  [&] { return show(a); });
    }
    applied.take(oracle::distance(big(multiply(m, v)), turned(a, big(v)), k_unit_step), with_vector);
    applied.take(oracle::distance(big(multiply_transposed(m, v)), turned(conjugate(a), big(v)), k_unit_step),
                 with_vector);
  }
  product.finish(DETENT_FIXED ? 0.5 : 2.0, k_strided);
  near_one.finish(k_normalise_quat_error, k_strided);
  any.finish(k_normalise_quat_error, k_strided);
  unit.finish(k_rotate_error, k_strided);
  real.finish(k_rotate_error, k_strided);
  matrix.finish(k_rotate_error, k_strided);
  applied.finish(k_rotate_error, k_strided);
}

DETENT_TEST(numbers, rotation_vectors_become_quaternions_and_return) {
  Line forth{k_config_name,  70,          "rotation_from_vector",
             "angle < 2^16", "component", DETENT_FIXED ? "step" : "step x (1 + angle)"};
  Line tiny{k_config_name, 71, "rotation_from_vector", "components < 2^-4", "component", "step"};
  Line back{k_config_name, 72, "rotation_vector_from", "unit quaternions", "component, rad", "step"};
  Line tiny_back{k_config_name, 73, "rotation_vector_from", "components < 2^-5", "component, rad", "step"};
  Samples samples{19};
  for (int i = 0; i < k_count; ++i) {
    const bool is_tiny = i % 2 == 0;
    const Vec3<Real> theta = samples.reals(is_tiny ? 41 : (i % 4 == 1 ? 48 : 61));
    const Quat q = rotation_from_vector(theta);
    const Big angle = oracle::length(big(theta));
    if (angle.number() == 0) {
      EXPECT_EQ(q, k_identity);
      continue;
    }
    const Big half = angle * Big(0.5);
    const Big factor = oracle::sine(half) / angle;
    const Big3 v = big(theta);
    // A float angle is itself rounded, by a step that is proportional to its size.
    const double angle_steps = DETENT_FIXED ? 1 : 1 + angle.number();
    (is_tiny ? tiny : forth)
        .take(std::max(oracle::distance(big(Vec3<Unit>{q.x, q.y, q.z}), {v.x * factor, v.y * factor, v.z * factor},
                                        k_unit_step),
                       oracle::distance(big(q.w), oracle::cosine(half), k_unit_step)) /
                  angle_steps,
              [&] { return show(theta); });

    const Quat p = is_tiny ? q : any_rotation(samples);
    const bool flip = p.w < Unit(0.0);
    const Big3 u = big(flip ? Vec3<Unit>{-p.x, -p.y, -p.z} : Vec3<Unit>{p.x, p.y, p.z});
    const Big size = oracle::length(u);
    if (size.number() == 0) continue;
    // From the sine alone where the angle is small, because the quaternion stores the sine more precisely there.
    Big true_angle = oracle::arc_tangent(size, big(flip ? -p.w : p.w));
    if (size.number() < 0.04) true_angle = oracle::apply<mpfr_asin>(size);
    const Big scale = Big(2.0) * true_angle / size;
    (size.number() < 0.03 ? tiny_back : back)
        .take(oracle::distance(big(rotation_vector_from(p)), {u.x * scale, u.y * scale, u.z * scale}, k_unit_step),
              [&] { return show(p); });
    EXPECT_EQ(rotation_vector_from(p), rotation_vector_from({-p.x, -p.y, -p.z, -p.w}));
  }
  forth.finish(k_rotation_error, k_strided);
  tiny.finish(k_rotation_error, k_strided);
  back.finish(k_rotation_vector_error, k_strided);
  tiny_back.finish(k_rotation_vector_error, k_strided);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
