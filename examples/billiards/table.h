#pragma once
#include <detent/body.h>

/// A nine-foot pool table and its balls: dimensions and physical constants, in SI units, with their sources.
///
/// [WPA] World Pool-Billiard Association, "Tournament Table & Equipment Specifications", effective November 2001.
/// [Alciatore] D. Alciatore, "Physics of Pool and Billiards", section "physical properties",
///     billiards.colostate.edu/threads/physics.html.
/// [pooltool] E. Kiefl, pooltool, default ball parameters, pooltool/objects/ball/params.py.
///
/// The frame: x along the table, from the head (where the break is played) to the foot; y up from the cloth; z across;
/// the origin at the table's centre.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace billiards {

inline constexpr double k_inch = 0.0254;

// Lengths, m. The constants below are only ever used in constant expressions: no double reaches a fixed-point build.
inline constexpr double k_half_length = 50 * k_inch;  ///< [WPA] 5: playing surface 100 x 50 in between the noses
inline constexpr double k_half_width = 25 * k_inch;
inline constexpr double k_string = k_half_length / 2;               ///< head and foot string and spot lie at -+ this x
inline constexpr double k_corner_mouth = 4.5625 * k_inch;           ///< [WPA] 9: 4.5 to 4.625 in, nose to nose
inline constexpr double k_side_mouth = 5.0625 * k_inch;             ///< [WPA] 9: 5 to 5.125 in
inline constexpr double k_cushion_width = 2 * k_inch;               ///< [WPA] 6: 1 7/8 to 2 in
inline constexpr double k_ball_radius = 2.25 / 2 * k_inch;          ///< [Alciatore] diameter 2.25 in
inline constexpr double k_nose_height = 0.635 * 2 * k_ball_radius;  ///< [WPA] 7: 62.5 to 64.5 % of the diameter

/// kg. [Alciatore] 6 oz.
inline constexpr double k_ball_mass = 6 * 0.028349523125;

/// The published values of pairs, and the material values that follow from them.
///
/// Friction and rolling resistance of a pair are geometric means. So a ball's own value is that of two balls, and cloth
/// or cushion needs the square of the pair's value over the ball's value:
///
///   friction            ball-ball 0.05 [Alciatore: 0.03 to 0.08]           ball 0.05
///                       ball-cloth 0.2 [Alciatore: 0.15 to 0.4, typ. 0.2]  cloth 0.2^2 / 0.05 = 0.8
///                       ball-cushion 0.2 [pooltool]                        cushion 0.8
///   rolling resistance  ball-cloth 0.01 [Alciatore: 0.005 to 0.015]        see below
///
/// The published rolling resistance is the deceleration over g of a ball that rolls; ours is a torque over (normal
/// force x radius). A torque t slows a rolling ball of moment 2/5 m r^2 by t / (7/5 m r), so the pair needs
/// 7/5 x 0.01 = 0.014 = sqrt(0.98 x 0.0002). It acts about the vertical axis too, and slows a ball that angular
/// velocities in place by 0.014 g / (2/5 r) = 12 rad/s^2 [Alciatore: 5 to 15].
///
/// The restitution of a pair is the larger of the two values, unless a material selects the smaller, as cloth and
/// cushions do: ball-ball 0.93 [Alciatore: 0.92 to 0.98], ball-cushion 0.8 [0.6 to 0.9], ball-cloth 0.5 [0.5].
inline constexpr double k_ball_friction = 0.05;
inline constexpr double k_ball_rolling = 0.0002;
inline constexpr double k_ball_restitution = 0.93;
inline constexpr double k_cloth_friction = 0.8;
inline constexpr double k_cloth_rolling = 0.98;
inline constexpr double k_cloth_restitution = 0.5;
inline constexpr double k_cushion_friction = 0.8;
inline constexpr double k_cushion_restitution = 0.8;

/// Converts literals at compile time, in every configuration. Rounding to floating point is intended.
consteval Vec3<Real> vector(double x, double y, double z) {
  return {static_cast<Real>(x), static_cast<Real>(y), static_cast<Real>(z)};
}
consteval Position point(double x, double y, double z) {
  return {static_cast<Coord>(x), static_cast<Coord>(y), static_cast<Coord>(z)};
}

}  // namespace billiards
}  // namespace DETENT_NAMESPACE
}  // namespace detent
