#pragma once
#include "examples/billiards/table.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace billiards {

/// A stroke as the cue ball leaves it.
struct Shot {
  const char* name;
  Vec3<Real> velocity;  ///< m/s
  Vec3<Real> spin;      ///< rad/s
};

/// A stroke by a level cue. `direction` is horizontal and of length 1 within 1e-3; `speed` is the ball's, m/s.
/// The tip strikes `right` and `above` of the ball's centre, as seen by the player, in ball radii; beyond 0.5 from the
/// centre it would slip off (D. Alciatore, "The Lag Shot", Billiards Digest, October 2011: miscue limit 0.5 R).
///
/// The impulse m v at the offset b turns the ball by m v b = 2/5 m r^2 w, so w = 5/2 (v / r) (b / r): about the
/// horizontal axis across the direction for `above`, about the vertical one for `right`. That the cue of a ball struck
/// to the side is pushed aside (squirt) is left out.
consteval Shot stroke(const char* name, double direction_x, double direction_z, double speed, double right,
                      double above) {
  const double square = direction_x * direction_x + direction_z * direction_z;
  if (square < 0.998 || square > 1.002 || right * right + above * above > 0.25) __builtin_trap();  // at compile time
  const double spin = 2.5 * speed / k_ball_radius;
  return {name, vector(direction_x * speed, 0.0, direction_z * speed),
          vector(spin * above * direction_z, spin * right, -spin * above * direction_x)};
}

/// The match. Speeds are within those of D. Alciatore, "How fast does the CB travel for a range of shots?"
/// (billiards.colostate.edu/faq/speed/typical): slow 0.45 to 0.89 m/s, medium to 1.9, fast to 3.2, power to 4.5, a
/// powerful break 11 to 13. Each shot is played where the one before left the balls; they were aimed in fx64, and in
/// the other configurations, whose balls lie elsewhere after the break, the same strokes meet what they meet.
inline constexpr Shot k_shots[] = {
    stroke("break", 1.0000, 0.0087, 8.9, 0.0, 0.1),
    stroke("stun", 0.9613, 0.2756, 2.4, 0.0, 0.0),            // no spin: stops at the ball, or leaves it square
    stroke("draw", -0.9613, -0.2756, 2.8, 0.0, -0.35),        // back spin: comes back from the ball
    stroke("follow", 0.9781, 0.2079, 1.9, 0.0, 0.4),          // struck at 2/5 r, it rolls from the start
    stroke("bank", 0.7254, 0.6884, 2.6, 0.0, 0.2),            // the ball goes to its pocket off a cushion
    stroke("right english", 0.8829, -0.4695, 1.5, 0.4, 0.1),  // side spin, which bites at a cushion
    stroke("left english", -0.3746, -0.9272, 1.4, -0.35, 0.2),
    stroke("drag", 0.3090, 0.9511, 1.6, 0.0, -0.1),  // a little back spin that the cloth takes off
};
inline constexpr uint32_t k_shot_count = sizeof(k_shots) / sizeof(k_shots[0]);

}  // namespace billiards
}  // namespace DETENT_NAMESPACE
}  // namespace detent
