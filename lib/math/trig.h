#pragma once
#include "math/arithmetic.h"

/// Angles and their functions. fx64, fx32 and f32 share integer functions. f64 has its own functions, which use
/// only the operations + - * /.
namespace detent {
inline namespace DETENT_NAMESPACE {

#if !defined(DETENT_F64)
/// An angle in turns: raw x 2^-32 turns. Sums wrap after a whole turn.
struct Angle {
  uint32_t raw;
  friend constexpr bool operator==(Angle a, Angle b) { return a.raw == b.raw; }
  friend constexpr Angle operator+(Angle a, Angle b) { return {a.raw + b.raw}; }
  friend constexpr Angle operator-(Angle a, Angle b) { return {a.raw - b.raw}; }
  friend constexpr Angle operator-(Angle a) { return {uint32_t{0} - a.raw}; }
};
#else
struct Angle {
  double radians;
  friend constexpr bool operator==(Angle a, Angle b) { return a.radians == b.radians; }
  friend constexpr Angle operator+(Angle a, Angle b) { return {a.radians + b.radians}; }
  friend constexpr Angle operator-(Angle a, Angle b) { return {a.radians - b.radians}; }
  friend constexpr Angle operator-(Angle a) { return {-a.radians}; }
};
#endif

/// The sine and the cosine of an angle. Both are exact at quarter turns. Error: k_sine_error.
void sine_cosine(Angle angle, Unit& sine, Unit& cosine);
/// The sine and the cosine of half the angle. The angle is first reduced to [-1/2, 1/2) turn (f64: not reduced). Error:
/// k_sine_error.
void sine_cosine_of_half(Angle angle, Unit& sine, Unit& cosine);
/// The sine and the cosine of half an angle, which is given in rad. Range: |angle| <= 2^17. Error: k_sine_error, plus
/// the effect of an error of 2^-34 turns in the angle.
void sine_cosine_of_half_radians(Real angle, Unit& sine, Unit& cosine);

#if !defined(DETENT_F64)
/// The sine of half an angle divided by the angle, and the cosine of half the angle, by series. `square`: 64 times the
/// square of the angle, rad. Range: square < 3/4. The omitted terms are below 2^-34.
struct HalfAngleSeries {
  Unit sine_ratio, cosine;
};
constexpr HalfAngleSeries half_angle_series(Unit square) {
  // sin(a/2) / a = 1/2 - a^2/48 + a^4/3840; cos(a/2) = 1 - a^2/8 + a^4/384
  return {Unit(0.5) - Unit(1.0 / 3072) * (square * (Unit(1.0) - Unit(1.0 / 5120) * square)),
          Unit(1.0) - scale_by_power(square * (Unit(1.0) - Unit(1.0 / 3072) * square), -9)};
}
inline constexpr Real k_series_angle_max = 0.0625;  ///< angles below this, rad, are in the range of half_angle_series()
#endif

/// Converts an angle in rad to an Angle, modulo one turn (f64: not reduced). Range: |angle| <= 2^17 rad. Rounding: to
/// nearest; error at most (1/2 + 2^-16) 2^-32 turns.
Angle angle_from_radians(Real angle);
/// Converts an angle to rad, in [-pi, pi). Rounding: to nearest.
Real radians(Angle angle);
/// The angle of the point (x, y): atan2(y, x), in (-1/2, 1/2] turn. (0, 0) gives 0. Error: k_arc_tangent_error. If the
/// result is exactly half a turn, radians() of it gives -pi instead of pi.
Angle arc_tangent(Unit y, Unit x);

#if DETENT_FIXED
/// Largest error of a sine or cosine, in steps (k_unit_step). The exhaustive test finds 0.6615.
inline constexpr double k_sine_error = 0.67;
#elif defined(DETENT_F32)
inline constexpr double k_sine_error = 0.52;
#else
inline constexpr double k_sine_error = 2.0;
#endif
#if DETENT_FIXED
inline constexpr double k_arc_tangent_error = 0.75;  ///< error of arc_tangent(), in units of 2^-32 turns
#elif defined(DETENT_F32)
inline constexpr double k_arc_tangent_error = 1.0;
#else
inline constexpr double k_arc_tangent_error = 6.0;  ///< error of arc_tangent(), in units of 2^-53 rad
#endif

}  // namespace DETENT_NAMESPACE
}  // namespace detent
