#pragma once
#include <detent/config.h>
#include <detent/detail/shared.h>
#include <detent/status.h>

/// @file
/// Numbers: fixed point, the number roles, vectors, rotations and poses; their conversions from and to the doubles of
/// the host; transforms between the axes of a body and of the world; poses for rendering. No world is needed.
///
/// A *role* (Coord, Real, Unit, Scaled) is a kind of quantity; each configuration represents it by a type of its own.
/// All code above lib/math uses the roles, and is compiled once per configuration. Ranges, resolutions and their
/// derivation: SPEC.md, "Numbers".
///
/// The from_host and to_host functions are the only conversions between the host's doubles and the library's numbers.
/// They read and write the bits of the double, so the caller's rounding mode, flush-to-zero and -ffast-math have no
/// effect.
///
/// Range of the arguments of the transforms: lengths below 2^16 m; angles of at most 2^16 rad; quaternions whose length
/// is 1 within 2^-10.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The result of fixed_from_double_bits(): a double converted to fixed point.
struct FromDouble {
  int64_t raw;    ///< the value times 2^frac, rounded to nearest, ties away from zero; 0 if not in_range
  bool in_range;  ///< false for NaN and infinity, and if the rounded |value| 2^frac is 2^(int_bits-1) or more
};
/// Converts an IEEE double, given by its bits, to a fixed-point number with `frac` fraction bits. The function uses
/// only integer arithmetic, so the caller's rounding mode and flush-to-zero have no effect. Range: 0 <= frac <= 62.
/// `int_bits`: the number of bits of the integer that stores the result, sign included, at most 64.
constexpr FromDouble fixed_from_double_bits(uint64_t bits, int frac, int int_bits) {
  const bool negative = (bits >> 63) != 0;
  const int biased = static_cast<int>((bits >> 52) & 0x7ff);
  if (biased == 0x7ff) return {0, false};
  if (biased == 0) return {0, true};  // zero and subnormals, which are below half the resolution of every format
  const uint64_t mantissa = (bits & 0xfffffffffffffu) | 0x10000000000000u;
  const int shift = biased - 1075 + frac;  // value 2^frac = mantissa 2^shift
  uint64_t magnitude = 0;
  if (shift >= 11) return {0, false};
  if (shift >= 0)
    magnitude = mantissa << shift;
  else if (shift >= -53)
    magnitude = (mantissa + (uint64_t{1} << (-shift - 1))) >> -shift;
  if ((magnitude >> (int_bits - 1)) != 0) return {0, false};
  return {negative ? -static_cast<int64_t>(magnitude) : static_cast<int64_t>(magnitude), true};
}

/// A two's complement fixed-point number: value = raw 2^-Frac.
/// Sums that overflow wrap (the ranges in SPEC.md exclude overflow); no operation saturates.
/// A floating-point literal converts at compile time, rounded to nearest. Only the from_host functions convert a
/// double at run time.
template <class Int, int Frac>
struct alignas(sizeof(Int)) Fixed {  // alignas: some targets align 8-byte members to less than 8
  /// The number of fraction bits.
  static constexpr int k_frac = Frac;
  /// The number of all bits, sign included.
  static constexpr int k_bits = static_cast<int>(sizeof(Int) * 8);
  /// The underlying integer type.
  using Raw = Int;
  /// The number times 2^Frac.
  Int raw;

  /// Not initialised; `{}` is zero.
  Fixed() = default;
  /// Converts a literal. Rounding: to nearest, ties away from zero. A literal out of range does not compile.
  // NOLINTNEXTLINE(google-explicit-constructor): a literal is meant to convert
  consteval Fixed(double literal) : raw(literal_raw(literal)) {}
  /// The number raw_value 2^-Frac.
  static constexpr Fixed from_raw(Int raw_value) {
    Fixed result;
    result.raw = raw_value;
    return result;
  }

  /// Comparisons of the values, exact.
  /// @{
  friend constexpr bool operator==(Fixed a, Fixed b) { return a.raw == b.raw; }
  friend constexpr bool operator<(Fixed a, Fixed b) { return a.raw < b.raw; }
  friend constexpr bool operator>(Fixed a, Fixed b) { return a.raw > b.raw; }
  friend constexpr bool operator<=(Fixed a, Fixed b) { return a.raw <= b.raw; }
  friend constexpr bool operator>=(Fixed a, Fixed b) { return a.raw >= b.raw; }
  /// @}
  /// Sums and differences: exact within the format's range. Overflow: wraps.
  /// @{
  friend constexpr Fixed operator+(Fixed a, Fixed b) { return wrapped(bits(a) + bits(b)); }
  friend constexpr Fixed operator-(Fixed a, Fixed b) { return wrapped(bits(a) - bits(b)); }
  friend constexpr Fixed operator-(Fixed a) { return wrapped(uint64_t{0} - bits(a)); }
  constexpr Fixed& operator+=(Fixed b) { return *this = *this + b; }
  constexpr Fixed& operator-=(Fixed b) { return *this = *this - b; }
  /// @}

 private:
  static constexpr uint64_t bits(Fixed a) { return static_cast<uint64_t>(static_cast<int64_t>(a.raw)); }
  static constexpr Fixed wrapped(uint64_t value) { return from_raw(static_cast<Int>(value)); }
  static constexpr Int literal_raw(double literal) {
    const FromDouble converted = fixed_from_double_bits(__builtin_bit_cast(uint64_t, literal), Frac, k_bits);
    if (!converted.in_range) __builtin_trap();  // at compile time: this literal is outside the format's range
    return static_cast<Int>(converted.raw);
  }
};

#if defined(DETENT_FX64)
using Coord = Fixed<int64_t, 32>;  ///< a coordinate of a world position, m: range +-2^31 m, resolution 2.3e-10 m
#elif defined(DETENT_FX32)
using Coord = Fixed<int32_t, 16>;  ///< m: range +-32 km, resolution 1.5e-5 m; the state also stores a finer remainder
#elif defined(DETENT_F32)
using Coord = Fixed<int64_t, 32>;  ///< m; the same type as in fx64
#else
using Coord = double;  ///< m
#endif

#if DETENT_FIXED
using Real = Fixed<int64_t, 46>;  ///< lengths, m, times, s, and speeds, m/s: range +-131 072, resolution 1.4e-14
using Unit = Fixed<int32_t, 30>;  ///< dimensionless, in (-2, 2): rotations, normals, lengths relative to a power of two
#elif defined(DETENT_F32)
using Real = float;
using Unit = float;
#else
using Real = double;
using Unit = double;
#endif

/// A fraction of a step, in [0, 1], with a resolution of 2^-62.
using Fraction = Fixed<int64_t, 62>;
/// Converts a fraction to a Real. Rounding: down.
Real real_from_fraction(Fraction fraction);
/// Converts a fraction to the nearest double, ties to even.
double fraction_to_host(Fraction fraction);

#if DETENT_FIXED
/// A signed number of wide range, for masses, densities, forces and impulses: value = mantissa x 2^exponent.
/// Canonical: the mantissa is 0 (and then the exponent 0), or 2^30 <= |mantissa| < 2^31. |exponent| <= 256.
/// The relative resolution is 2^-30. A floating-point literal converts at compile time; scaled_from_host() converts a
/// double at run time.
struct Scaled {
  int32_t mantissa;  ///< 0, or 2^30 <= |mantissa| < 2^31
  int32_t exponent;  ///< within +-256; 0 if the mantissa is 0

  /// Not initialised; `{}` is zero.
  Scaled() = default;
  /// Converts a literal: 0, or of a magnitude in [2^-200, 2^200]. Other literals do not compile. Rounding: to nearest,
  /// ties away from zero.
  // NOLINTNEXTLINE(google-explicit-constructor): a literal is meant to convert
  consteval Scaled(double literal) : Scaled(from_double_bits(__builtin_bit_cast(uint64_t, literal))) {
    if (mantissa == 0 && literal != 0) __builtin_trap();  // at compile time: NaN, infinite or out of range
  }
  /// The number mantissa x 2^exponent, which must be canonical.
  static constexpr Scaled from_parts(int32_t mantissa, int32_t exponent) {
    Scaled result;
    result.mantissa = mantissa;
    result.exponent = exponent;
    return result;
  }
  /// Converts an IEEE double, given by its bits. Rounding: to nearest, ties away from zero. The result is 0 for NaN,
  /// infinity and |value| outside [2^-200, 2^200].
  static constexpr Scaled from_double_bits(uint64_t bits) {
    const int biased = static_cast<int>((bits >> 52) & 0x7ff);
    if (biased < 1023 - 200 || biased > 1023 + 200) return from_parts(0, 0);
    const uint64_t full = (bits & 0xfffffffffffffu) | 0x10000000000000u;  // 53 bits
    uint64_t magnitude = (full + (uint64_t{1} << 21)) >> 22;              // 31 bits, or 2^31 after the carry
    int32_t exponent = biased - 1023 - 30;
    if ((magnitude >> 31) != 0) {
      magnitude >>= 1;
      ++exponent;
    }
    const int32_t mantissa = static_cast<int32_t>(magnitude);
    return from_parts((bits >> 63) != 0 ? -mantissa : mantissa, exponent);
  }
  /// Equal in value.
  friend constexpr bool operator==(Scaled a, Scaled b) { return a.mantissa == b.mantissa && a.exponent == b.exponent; }
};
#else
/// A number of wide range: in float configurations a Real.
using Scaled = Real;
#endif

/// Three components along right-handed axes.
template <class T>
struct Vec3 {
  T x;  ///< along the first axis
  T y;  ///< along the second axis
  T z;  ///< along the third axis
  /// Equal in each component.
  DETENT_SHARED friend constexpr bool operator==(const Vec3& a, const Vec3& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  }
};

/// A position in the world, m.
using Position = Vec3<Coord>;

/// A rotation as a unit quaternion, w + xi + yj + zk, from local to world: v_world = q v_local q*.
struct Quat {
  Unit x;  ///< the coefficient of i
  Unit y;  ///< the coefficient of j
  Unit z;  ///< the coefficient of k
  Unit w;  ///< the real part
  /// Equal in each component. q and -q are the same rotation, but they are not equal.
  friend constexpr bool operator==(const Quat& a, const Quat& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w;
  }
};

/// A rotation matrix, by columns.
struct Matrix3 {
  Vec3<Unit> column[3];  ///< column[i] is the image of local axis i
};

/// Position and rotation of a body.
struct Pose {
  Position position;  ///< position of the centre of mass, m, world
  Quat rotation;      ///< local to world, of length 1
};

/// Sets `result` to `value`, rounded to nearest, ties away from zero (f32: to even). -0 becomes +0, and so does a
/// number that is too small for Real, Unit or Coord. Range: |value| < 2^17 for Real, < 2 for Unit, < 2^31 (fx32: 2^15)
/// for Coord. For Scaled: 0, or 2^-100 <= |value| < 2^100. Errors: out_of_range, also for NaN and infinity; `result` is
/// then unchanged.
/// @{
Status real_from_host(double value, Real& result);
Status unit_from_host(double value, Unit& result);
Status coord_from_host(double value, Coord& result);
Status scaled_from_host(double value, Scaled& result);
/// @}

/// Converts a number to the nearest double, ties to even.
/// @{
double real_to_host(Real value);
double unit_to_host(Unit value);
double coord_to_host(Coord value);
double scaled_to_host(Scaled value);
/// @}

/// Transforms `point`, m, in the body's axes and relative to its centre of mass, to a position in the world. Rounding:
/// to the resolution of a position. Overflow: clamped to the range of a position.
Position to_world(const Pose& pose, const Vec3<Real>& point);
/// Transforms a position in the world to a point, m, in the body's axes and relative to its centre of mass. Range:
/// `point` is within 2^15 m of the body in each coordinate.
Vec3<Real> to_local(const Pose& pose, const Position& point);
/// Transforms a vector from the body's axes to the world's.
Vec3<Real> vector_to_world(const Quat& rotation, const Vec3<Real>& vector);
/// Transforms a vector from the world's axes to the body's.
Vec3<Real> vector_to_local(const Quat& rotation, const Vec3<Real>& vector);
/// Returns `rotation` followed by a rotation by |rotation_vector| rad about the direction of `rotation_vector`, world
/// axes. The result has length 1.
Quat rotated_by(const Quat& rotation, const Vec3<Real>& rotation_vector);

/// A pose relative to a camera, in world axes.
struct CameraRelative {
  float position[3];  ///< m; x, y, z from the camera to the body's centre of mass
  float rotation[4];  ///< x, y, z, w; from local to world
};

/// Returns `pose` relative to a camera at the position `camera`. Rounding: the exact difference of the positions is
/// rounded to the nearest float, so the result is as precise at 10,000 km from the world's origin as at the origin.
CameraRelative relative_to_camera(const Pose& pose, const Position& camera);

/// Interpolates between the poses of two ticks. Range: alpha in [0, 1]; coordinates less than 2^31 m apart.
/// The position is interpolated linearly; the rotation by a normalised weighted mean along the shorter arc. Alpha = 0
/// gives `from`, and alpha = 1 gives `to`; the rotation is renormalised, and may be the negative quaternion of that in
/// `to`.
Pose interpolate(const Pose& from, const Pose& to, Unit alpha);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
